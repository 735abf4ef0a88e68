#include "host/material_uniforms.h"

#include <algorithm>
#include <cmath>

namespace supple::host {

namespace {

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

} // namespace

uint32_t materialFlags(const SuppleMaterialInfo& material, bool uv1) {
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
    for (const SuppleTextureInfo* texture : {&material.baseColor, &material.metallicRoughness, &material.normal,
                                             &material.occlusion, &material.emissive, &material.trim}) {
        set(uv1 && texture->uvSet == 1, shared::kMaterialUvs1);
        set(texture->image != SUPPLE_NO_IMAGE, hasTexture);
        hasTexture <<= 1;
    }
    return flags;
}

shared::MaterialUniforms materialUniforms(const SuppleMaterialInfo& material, bool uv1) {
    shared::MaterialUniforms uniforms{};
    const float* color = material.baseColorFactor;
    uniforms.baseColor = glm::vec4(color[0], color[1], color[2], color[3]);
    const float* emissive = material.emissiveFactor;
    uniforms.emissive = glm::vec4(emissive[0], emissive[1], emissive[2], 0.0f) * material.emissiveStrength;
    uniforms.metallic = material.metallicFactor;
    uniforms.roughness = material.roughnessFactor;
    uniforms.normalScale = material.normalScale;
    uniforms.occlusionStrength = material.occlusionStrength;
    uniforms.places[shared::kBaseColor] = placeOf(material.baseColor, uv1);
    uniforms.places[shared::kMetallicRoughness] = placeOf(material.metallicRoughness, uv1);
    uniforms.places[shared::kNormal] = placeOf(material.normal, uv1);
    uniforms.places[shared::kOcclusion] = placeOf(material.occlusion, uv1);
    uniforms.places[shared::kEmissive] = placeOf(material.emissive, uv1);
    uniforms.places[shared::kTrim] = placeOf(material.trim, uv1);
    const bool ownTrim = hasOwnTrim(material);
    uniforms.cutoff = ownTrim ? material.trimCutoff : material.alphaCutoff;
    uniforms.trimChannel = ownTrim ? material.trimChannel : 3;
    uniforms.trimTiles = static_cast<float>(std::max(material.trimTiles, 1u));
    return uniforms;
}

} // namespace supple::host
