#include "host/material_uniforms.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace supple::host {

namespace {

using shared::kClearcoat;
using shared::kLayerSlotsPerWord;

shared::TexturePlace placeOf(const SuppleTextureInfo& texture, bool uv1) {
    const float c = std::cos(texture.rotation);
    const float s = std::sin(texture.rotation);
    return {{c * texture.scale[0], s * texture.scale[1], texture.offset[0], uv1 && texture.uvSet == 1 ? 1.0f : 0.0f},
            {-s * texture.scale[0], c * texture.scale[1], texture.offset[1], 0.0f}};
}

/// Holes that the base color's alpha does not make.
bool hasOwnTrim(const SuppleMaterialInfo& material) {
    return material.trimDomain != SUPPLE_TRIM_NONE && material.trimAlpha == 0;
}

/// See MaterialUniforms::dielectric; the limit is left to the shader, as a texture comes before it.
glm::vec4 dielectricOf(const SuppleMaterialLayers& layers) {
    const float side = layers.ior > 0.0f ? (layers.ior - 1.0f) / (layers.ior + 1.0f) : 1.0f;
    const float* color = layers.specularColorFactor;
    return {side * side * glm::vec3(color[0], color[1], color[2]), layers.specularFactor};
}

bool isUsualDielectric(const SuppleMaterialLayers& layers) {
    return layers.specular.image == SUPPLE_NO_IMAGE && layers.specularColor.image == SUPPLE_NO_IMAGE &&
           layers.ior == 1.5f && layers.specularFactor == 1.0f &&
           std::all_of(std::begin(layers.specularColorFactor), std::end(layers.specularColorFactor),
                       [](float channel) { return channel == 1.0f; });
}

/// What light loses inside, for each unit of its way.
glm::vec4 extinctionOf(const SuppleMaterialLayers& layers) {
    constexpr float kBlack = 1e-4f; // infinity would be no number where the way is 0
    glm::vec4 lost(0.0f, 0.0f, 0.0f, layers.thicknessFactor);
    for (int channel = 0; channel < 3 && layers.attenuationDistance > 0.0f; ++channel)
        lost[channel] = -std::log(std::max(layers.attenuationColor[channel], kBlack)) / layers.attenuationDistance;
    return lost;
}

/// The word that has a texture's place.
template <class Slots>
auto& wordOf(Slots& slots, uint32_t texture) {
    return slots[(texture - kClearcoat) / kLayerSlotsPerWord];
}

bool hasSheen(const SuppleMaterialLayers& layers) {
    return std::any_of(std::begin(layers.sheenColorFactor), std::end(layers.sheenColorFactor),
                       [](float channel) { return channel > 0.0f; });
}

} // namespace

bool isGlass(const SuppleMaterialInfo& material, const SuppleMaterialLayers& layers) {
    return layers.transmissionFactor > 0.0f && material.unlit == 0;
}

bool needsTangents(const SuppleMaterialInfo& material, const SuppleMaterialLayers& layers) {
    return material.normal.image != SUPPLE_NO_IMAGE || layers.anisotropyStrength > 0.0f;
}

uint32_t materialFlags(const SuppleMaterialInfo& material, const SuppleMaterialLayers& layers, bool uv1) {
    uint32_t flags = 0;
    const bool ownTrim = hasOwnTrim(material);
    // A mask without a texture is a trim too: of the alphas that multiply a white one.
    const bool mask = material.alphaMode == SUPPLE_ALPHA_MASK && !ownTrim;
    const auto set = [&](bool yes, uint32_t flag) { flags |= yes ? flag : 0; };
    set(material.doubleSided != 0, shared::kMaterialDoubleSided);
    set(mask, shared::kMaterialMask | shared::kMaterialTrim | shared::kMaterialTrimAlpha);
    set(material.alphaMode == SUPPLE_ALPHA_BLEND, shared::kMaterialTranslucent);
    set(material.alphaMode == SUPPLE_ALPHA_BLEND && !ownTrim, shared::kMaterialTrimAlpha);
    set(material.unlit != 0, shared::kMaterialUnlit);
    set(ownTrim, shared::kMaterialTrim);
    set(material.trimDomain == SUPPLE_TRIM_FACE, shared::kMaterialTrimFace);
    uint32_t hasTexture = shared::kMaterialTexture; // in the order of shared::kBaseColor and so on
    for (const SuppleTextureInfo* texture : texturesOf(material, layers)) {
        set(uv1 && texture->uvSet == 1, shared::kMaterialUvs1);
        set(texture->image != SUPPLE_NO_IMAGE && hasTexture < shared::kMaterialTexture << shared::kClearcoat,
            hasTexture);
        hasTexture <<= 1;
    }
    set(layers.clearcoatFactor > 0.0f, shared::kMaterialClearcoat);
    set(hasSheen(layers), shared::kMaterialSheen);
    set(isGlass(material, layers), shared::kMaterialTransmission);
    set(!isUsualDielectric(layers), shared::kMaterialSpecular);
    set(layers.anisotropyStrength > 0.0f, shared::kMaterialAnisotropy);
    set(layers.diffuseTransmissionFactor > 0.0f, shared::kMaterialDiffuseTransmission);
    set(layers.iridescenceFactor > 0.0f, shared::kMaterialIridescence);
    return flags;
}

LayerSlots layerSlots(const SuppleMaterialInfo& material, const SuppleMaterialLayers& layers) {
    LayerSlots slots{shared::kNoLayerSlots, shared::kNoLayerSlots};
    const auto textures = texturesOf(material, layers);
    uint32_t next = 0;
    for (uint32_t i = shared::kClearcoat; i < textures.size() && next < shared::kLayerTextureCount; ++i) {
        if (textures[i]->image == SUPPLE_NO_IMAGE)
            continue;
        wordOf(slots, i) ^= (shared::kNoLayerSlot ^ next++) << SUPPLE_LAYER_SLOT_SHIFT(i);
    }
    return slots;
}

uint32_t layerSlotOf(const LayerSlots& slots, uint32_t texture) {
    return SUPPLE_LAYER_SLOT(wordOf(slots, texture), texture);
}

shared::MaterialUniforms materialUniforms(const SuppleMaterialInfo& material, const SuppleMaterialLayers& layers,
                                          bool uv1) {
    shared::MaterialUniforms uniforms{};
    const float* color = material.baseColorFactor;
    uniforms.baseColor = glm::vec4(color[0], color[1], color[2], color[3]);
    const float* emissive = material.emissiveFactor;
    uniforms.emissive = glm::vec4(emissive[0], emissive[1], emissive[2], 0.0f) * material.emissiveStrength;
    uniforms.metallic = material.metallicFactor;
    uniforms.roughness = material.roughnessFactor;
    uniforms.normalScale = material.normalScale;
    uniforms.occlusionStrength = material.occlusionStrength;
    const auto textures = texturesOf(material, layers);
    for (size_t slot = 0; slot < textures.size(); ++slot)
        uniforms.places[slot] = placeOf(*textures[slot], uv1);
    const float* sheen = layers.sheenColorFactor;
    uniforms.sheen = glm::vec4(sheen[0], sheen[1], sheen[2], layers.sheenRoughnessFactor);
    uniforms.dielectric = dielectricOf(layers);
    uniforms.clearcoat = layers.clearcoatFactor;
    uniforms.clearcoatRoughness = layers.clearcoatRoughnessFactor;
    uniforms.clearcoatNormalScale = layers.clearcoatNormalScale;
    uniforms.transmission = layers.transmissionFactor;
    const float* through = layers.diffuseTransmissionColorFactor;
    uniforms.diffuseTransmission = glm::vec4(through[0], through[1], through[2], layers.diffuseTransmissionFactor);
    uniforms.extinction = extinctionOf(layers);
    uniforms.anisotropy = glm::vec4(layers.anisotropyStrength, std::cos(layers.anisotropyRotation),
                                    std::sin(layers.anisotropyRotation), 0.0f);
    uniforms.iridescence = glm::vec4(layers.iridescenceFactor, layers.iridescenceIor,
                                     layers.iridescenceThicknessMinimum, layers.iridescenceThicknessMaximum);
    const bool ownTrim = hasOwnTrim(material);
    uniforms.cutoff = ownTrim ? material.trimCutoff : material.alphaCutoff;
    uniforms.trimChannel = ownTrim ? material.trimChannel : 3;
    uniforms.trimTiles = static_cast<float>(std::max(material.trimTiles, 1u));
    return uniforms;
}

} // namespace supple::host
