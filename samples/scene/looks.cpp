#include "looks.h"

#include "host/must.h"
#include "host/picture.h"
#include "host/texture.h"

#include <algorithm>
#include <optional>
#include <string_view>

namespace market {

namespace {

/// By the names of the files' materials.
Tint tintOf(std::string_view material, Kind kind) {
    if (kind != Kind::wren)
        return Tint::cloth; // a dragon is of one color, more or less
    if (material == "cloth" || material == "band")
        return Tint::cloth;
    if (material == "hair")
        return Tint::hair;
    if (material == "leather" || material == "strap")
        return Tint::leather;
    return material == "face" || material == "skin" ? Tint::skin : Tint::none;
}

Image whiteTexture(Device& device) {
    Picture white = Picture::blank(1, 1);
    std::fill(white.rgba.begin(), white.rgba.end(), uint8_t{255});
    return must(uploadTexture(device, white));
}

} // namespace

Looks::Looks(Device& device, const Market& market) : sampler_(must(createTextureSampler(device))) {
    textures_.push_back(whiteTexture(device));
    std::array<std::optional<Look>, kKinds> ofKinds;
    for (size_t i = 0; i < market.cast().size(); ++i) {
        const Figure& figure = market.cast()[i];
        std::optional<Look>& ofKind = ofKinds[static_cast<size_t>(figure.kind)];
        if (!ofKind) { // figures of a file have its materials together
            ofKind = addMaterials(device, market.asset(i));
            for (uint32_t m = ofKind->firstMaterial; m < ofKind->lastMaterial; ++m) {
                SuppleMaterialInfo info{};
                must(market.asset(i).materialInfo(m - ofKind->firstMaterial, info), "suppleGetMaterialInfo");
                materials_[m].tint = static_cast<uint32_t>(tintOf(info.name, figure.kind));
            }
        }
        looks_.push_back(*ofKind);
        looks_.back().tints = figure.tints;
    }
    constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    materialBuffer_ = must(device.uploadBuffer(materials_.data(), materials_.size() * sizeof(Material), kStorage));
    lookBuffer_ = must(device.uploadBuffer(looks_.data(), looks_.size() * sizeof(Look), kStorage));
}

Look Looks::addMaterials(Device& device, const supple::Asset& asset) {
    Look look;
    look.firstMaterial = static_cast<uint32_t>(materials_.size());
    known_.clear();
    SuppleAssetInfo info{};
    must(asset.info(info), "suppleGetAssetInfo");
    for (uint32_t i = 0; i < info.materialCount; ++i) {
        SuppleMaterialInfo from{};
        must(asset.materialInfo(i, from), "suppleGetMaterialInfo");
        Material& material = materials_.emplace_back();
        std::copy_n(from.baseColorFactor, 4, &material.baseColor[0]);
        material.metallic = from.metallicFactor;
        material.roughness = from.roughnessFactor;
        addTextureSet({addTexture(device, asset, from.baseColor, true),
                       addTexture(device, asset, from.metallicRoughness, false)});
    }
    look.lastMaterial = static_cast<uint32_t>(materials_.size());
    materials_.emplace_back();
    addTextureSet({});
    return look;
}

void Looks::addTextureSet(Textures textures) {
    const auto known = std::find(textureSets_.begin(), textureSets_.end(), textures);
    setOfMaterial_.push_back(static_cast<uint32_t>(known - textureSets_.begin()));
    if (known == textureSets_.end())
        textureSets_.push_back(textures);
}

uint32_t Looks::textureSetOf(uint32_t figure, uint32_t material) const {
    const Look& look = looks_[figure];
    const uint32_t count = look.lastMaterial - look.firstMaterial; // of those that the file has
    return setOfMaterial_[look.firstMaterial + std::min(material, count)];
}

uint32_t Looks::addTexture(Device& device, const supple::Asset& asset, const SuppleTextureInfo& texture, bool isColor) {
    if (texture.image == SUPPLE_NO_IMAGE)
        return 0;
    const auto known =
        std::find_if(known_.begin(), known_.end(), [&](const auto& one) { return one.first == texture.image; });
    if (known != known_.end())
        return known->second;
    SuppleImageInfo image{};
    must(asset.imageInfo(texture.image, image), "suppleGetImageInfo");
    const Picture picture =
        must(decodePicture({static_cast<const std::byte*>(image.bytes), image.byteCount}, image.name));
    textures_.push_back(must(uploadTexture(device, picture, isColor ? TextureKind::color : TextureKind::data)));
    known_.emplace_back(texture.image, static_cast<uint32_t>(textures_.size() - 1));
    return known_.back().second;
}

Write Looks::textureWrite(uint32_t binding, uint32_t texture) const {
    return sampledImage(binding, textures_[texture], sampler_);
}

} // namespace market
