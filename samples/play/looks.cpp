#include "looks.h"

#include "host/must.h"
#include "host/picture.h"
#include "host/texture.h"

#include <algorithm>

namespace play {

namespace {

Image plainTexture(Device& device, std::array<uint8_t, 4> color) {
    Picture picture = Picture::blank(1, 1);
    std::copy(color.begin(), color.end(), picture.rgba.begin());
    return must(uploadTexture(device, picture, TextureKind::data));
}

constexpr uint32_t kWhite = 0, kFlat = 1;

} // namespace

Looks::Looks(Device& device, const supple::Asset& asset) : sampler_(must(createTextureSampler(device))) {
    images_.push_back(plainTexture(device, {255, 255, 255, 255}));
    images_.push_back(plainTexture(device, {128, 128, 255, 255}));
    SuppleAssetInfo info{};
    must(asset.info(info), "suppleGetAssetInfo");
    for (uint32_t i = 0; i < info.materialCount; ++i) {
        SuppleMaterialInfo from{};
        must(asset.materialInfo(i, from), "suppleGetMaterialInfo");
        Look& look = looks_.emplace_back();
        std::copy_n(from.baseColorFactor, 4, &look.baseColor[0]);
        look.metallic = from.metallicFactor;
        look.roughness = from.roughnessFactor;
        look.textures = {addTexture(device, asset, from.baseColor, kColorTexture),
                         addTexture(device, asset, from.metallicRoughness, kSurfaceTexture),
                         addTexture(device, asset, from.normal, kNormalTexture)};
    }
    looks_.push_back({.textures = {kWhite, kWhite, kFlat}});
}

uint32_t Looks::indexOf(uint32_t material) const {
    return std::min(material, static_cast<uint32_t>(looks_.size()) - 1);
}

uint32_t Looks::addTexture(Device& device, const supple::Asset& asset, const SuppleTextureInfo& texture, Texture kind) {
    if (texture.image == SUPPLE_NO_IMAGE)
        return kind == kNormalTexture ? kFlat : kWhite;
    const auto known =
        std::find_if(known_.begin(), known_.end(), [&](const auto& one) { return one.first == texture.image; });
    if (known != known_.end())
        return known->second;
    SuppleImageInfo image{};
    must(asset.imageInfo(texture.image, image), "suppleGetImageInfo");
    const Picture picture =
        must(decodePicture({static_cast<const std::byte*>(image.bytes), image.byteCount}, image.name));
    images_.push_back(
        must(uploadTexture(device, picture, kind == kColorTexture ? TextureKind::color : TextureKind::data)));
    known_.emplace_back(texture.image, static_cast<uint32_t>(images_.size()) - 1);
    return known_.back().second;
}

std::array<Write, kTextures> Looks::writes(const Look& look) const {
    const auto write = [&](Texture kind) { return sampledImage(kind, images_[look.textures[kind]], sampler_); };
    return {write(kColorTexture), write(kSurfaceTexture), write(kNormalTexture)};
}

} // namespace play
