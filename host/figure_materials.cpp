#include "host/figure_materials.h"

#include "host/material_uniforms.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <supple/supple.hpp>
#include <utility>

namespace supple::host {

namespace {

float linearFromSrgb(float x) {
    return x < 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

/// In linear light, from every few pixels.
glm::vec3 averageColorOf(const Picture& picture) {
    glm::vec3 sum(0.0f);
    float count = 0.0f;
    const size_t pixels = picture.rgba.size() / 4;
    const size_t step = std::max<size_t>(pixels / 4096, 1);
    for (size_t i = 0; i < pixels; i += step) {
        for (int channel = 0; channel < 3; ++channel)
            sum[channel] +=
                linearFromSrgb(static_cast<float>(picture.rgba[i * 4 + static_cast<size_t>(channel)]) / 255.0f);
        count += 1.0f;
    }
    return sum / std::max(count, 1.0f);
}

/// What the tools paint faces with that have no material.
SuppleMaterialInfo whiteClay() {
    SuppleMaterialInfo info{};
    info.structSize = sizeof info;
    info.name = "";
    std::fill(std::begin(info.baseColorFactor), std::end(info.baseColorFactor), 1.0f);
    info.roughnessFactor = 0.42f;
    info.normalScale = info.occlusionStrength = info.emissiveStrength = 1.0f;
    for (SuppleTextureInfo* texture :
         {&info.baseColor, &info.metallicRoughness, &info.normal, &info.occlusion, &info.emissive, &info.trim}) {
        texture->image = SUPPLE_NO_IMAGE;
        texture->scale[0] = texture->scale[1] = 1.0f;
    }
    return info;
}

/// What files call the textures of layers, from shared::kClearcoat on.
constexpr std::array kLayerTextureNames = {"clearcoatTexture",
                                           "clearcoatRoughnessTexture",
                                           "clearcoatNormalTexture",
                                           "sheenColorTexture",
                                           "sheenRoughnessTexture",
                                           "transmissionTexture",
                                           "anisotropyTexture",
                                           "diffuseTransmissionColorTexture",
                                           "specularTexture",
                                           "specularColorTexture",
                                           "iridescenceTexture",
                                           "iridescenceThicknessTexture",
                                           "diffuseTransmissionTexture",
                                           "thicknessTexture"};
static_assert(kLayerTextureNames.size() == shared::kTextureCount - shared::kClearcoat);

/// A material may have more textures of layers than shaders look up.
void leaveOutTooMany(const std::string& path, SuppleMaterialInfo& info, SuppleMaterialLayers& layers) {
    const LayerSlots slots = layerSlots(info, layers);
    const auto textures = texturesOf(info, layers);
    std::string left;
    for (uint32_t which = shared::kClearcoat; which < textures.size(); ++which) {
        if (textures[which]->image == SUPPLE_NO_IMAGE || layerSlotOf(slots, which) != shared::kNoLayerSlot)
            continue;
        textures[which]->image = SUPPLE_NO_IMAGE;
        left.append(left.empty() ? "" : ", ").append(kLayerTextureNames[which - shared::kClearcoat]);
    }
    if (!left.empty())
        std::fprintf(stderr, "warning: %s: material %s: %s: left out, as %u textures of layers are drawn\n",
                     path.c_str(), info.name, left.c_str(), shared::kLayerTextureCount);
}

} // namespace

Status FigureMaterials::load(Context& context, SuppleAsset asset, const std::string& path) {
    SuppleAssetInfo assetInfo{};
    assetInfo.structSize = sizeof assetInfo;
    if (const Status status =
            context.check(suppleGetAssetInfo(context.handle(), asset, &assetInfo), "suppleGetAssetInfo");
        !status)
        return status.error();
    for (uint32_t i = 0; i < assetInfo.materialCount; ++i) {
        SuppleMaterialInfo info{};
        info.structSize = sizeof info;
        if (const Status status =
                context.check(suppleGetMaterialInfo(context.handle(), asset, i, &info), "suppleGetMaterialInfo");
            !status)
            return status.error();
        infos_.push_back(info);
        SuppleMaterialLayers layers{};
        layers.structSize = sizeof layers;
        if (const Status status =
                context.check(suppleGetMaterialLayers(context.handle(), asset, i, &layers), "suppleGetMaterialLayers");
            !status)
            return status.error();
        layers_.push_back(layers);
    }
    infos_.push_back(whiteClay());
    layers_.push_back(defaultMaterialLayers());
    knowsNoSides_ = path.ends_with(".obj") || path.ends_with(".OBJ");
    return loadTextures(context, asset, path);
}

Status FigureMaterials::loadTextures(Context& context, SuppleAsset asset, const std::string& path) {
    Picture white = Picture::blank(1, 1);
    std::fill(white.rgba.begin(), white.rgba.end(), uint8_t{255});
    if (const Result<size_t> first = upload(context.device(), white, TextureKind::color); !first)
        return first.error();
    for (size_t i = 0; i < infos_.size(); ++i) {
        SuppleMaterialInfo& info = infos_[i];
        SuppleMaterialLayers& layers = layers_[i];
        std::array<size_t, shared::kTextureCount>& slots = slots_.emplace_back();
        const bool blend = info.alphaMode == SUPPLE_ALPHA_BLEND && info.trimDomain == SUPPLE_TRIM_NONE;
        if (blend)
            info.trim = info.baseColor; // what is nearly clear casts no shadow
        const TextureKind trimKind = info.trimAlpha != 0 || blend          ? TextureKind::color
                                     : info.trimDomain == SUPPLE_TRIM_FACE ? TextureKind::tiles
                                                                           : TextureKind::data;
        const bool ownTrim = info.trimDomain != SUPPLE_TRIM_NONE && info.trimAlpha == 0;
        const auto kindOf = [&](uint32_t slot) {
            const bool isColor = slot == shared::kBaseColor || slot == shared::kEmissive ||
                                 slot == shared::kSheenColor || slot == shared::kDiffuseTransmissionColor ||
                                 slot == shared::kSpecularColor;
            return slot == shared::kTrim ? trimKind : (isColor ? TextureKind::color : TextureKind::data);
        };
        const auto textures = texturesOf(info, layers);
        for (uint32_t slot = 0; slot < textures.size(); ++slot) {
            SuppleTextureInfo& texture = *textures[slot];
            const bool required = slot == shared::kTrim && ownTrim;
            const Result<size_t> loaded = load(context, asset, path, texture, kindOf(slot), required);
            if (!loaded)
                return loaded.error();
            slots[slot] = *loaded;
            if (*loaded == 0)
                texture.image = SUPPLE_NO_IMAGE; // also one that cannot be read
        }
        leaveOutTooMany(path, info, layers);
    }
    return success();
}

bool FigureMaterials::hasMaps(uint32_t material) const {
    const std::array<size_t, shared::kTextureCount>& slots = slots_[indexOf(material)];
    return slots[shared::kNormal] != 0 || slots[shared::kOcclusion] != 0 || slots[shared::kEmissive] != 0 ||
           layers_[indexOf(material)].anisotropyStrength > 0.0f;
}

bool FigureMaterials::hasNormalMaps() const {
    return std::any_of(slots_.begin(), slots_.end(), [](const auto& slots) { return slots[shared::kNormal] != 0; });
}

bool FigureMaterials::needTangents() const {
    for (size_t i = 0; i < infos_.size(); ++i) {
        if (needsTangents(infos_[i], layers_[i]))
            return true;
    }
    return false;
}

Result<size_t> FigureMaterials::load(Context& context, SuppleAsset asset, const std::string& path,
                                     const SuppleTextureInfo& texture, TextureKind kind, bool required) {
    if (texture.image == SUPPLE_NO_IMAGE)
        return size_t{0};
    const auto [known, isNew] = known_.try_emplace({texture.image, kind}, 0);
    if (!isNew)
        return known->second;
    const auto decode = [&](uint32_t image) -> Result<Picture> {
        SuppleImageInfo info{};
        info.structSize = sizeof info;
        if (const Status status =
                context.check(suppleGetImageInfo(context.handle(), asset, image, &info), "suppleGetImageInfo");
            !status)
            return status.error();
        const std::string name = info.name[0] != '\0' ? info.name : std::to_string(image);
        return decodePicture(std::span(static_cast<const std::byte*>(info.bytes), info.byteCount),
                             path + (required ? ": trim image " : ": image ") + name);
    };
    Result<Picture> picture = decode(texture.image);
    if (!picture && texture.alternateImage != SUPPLE_NO_IMAGE) {
        if (Result<Picture> alternate = decode(texture.alternateImage))
            picture = std::move(alternate);
    }
    if (!picture && required)
        return picture.error();
    if (!picture) {
        // It takes nothing from the shape: draw without it, but say so.
        if (unread_.insert(texture.image).second)
            std::fprintf(stderr, "warning: %s: left out\n", picture.error().message.c_str());
        return known->second;
    }
    Result<size_t> uploaded = upload(context.device(), *picture, kind);
    if (uploaded)
        known->second = *uploaded;
    return uploaded;
}

Result<size_t> FigureMaterials::upload(Device& device, const Picture& picture, TextureKind kind) {
    Result<Image> image = uploadTexture(device, picture, kind);
    if (!image)
        return image.error();
    textures_.push_back({std::move(*image), averageColorOf(picture)});
    return textures_.size() - 1;
}

glm::vec3 FigureMaterials::averageColor(size_t index) const {
    const float* factor = infos_[index].baseColorFactor;
    return glm::vec3(factor[0], factor[1], factor[2]) * textures_[slots_[index][shared::kBaseColor]].average;
}

} // namespace supple::host
