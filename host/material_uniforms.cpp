#include "host/material_uniforms.h"

#include <algorithm>
#include <cmath>

namespace supple::host {

namespace {

shared::TexturePlace placeOf(const SuppleTextureInfo& texture) {
    const float c = std::cos(texture.rotation);
    const float s = std::sin(texture.rotation);
    return {{c * texture.scale[0], s * texture.scale[1], texture.offset[0], 0.0f},
            {-s * texture.scale[0], c * texture.scale[1], texture.offset[1], 0.0f}};
}

} // namespace

shared::MaterialUniforms materialUniforms(const SuppleMaterialInfo& material, bool uv1) {
    shared::MaterialUniforms uniforms{};
    const float* color = material.baseColorFactor;
    uniforms.baseColor = glm::vec4(color[0], color[1], color[2], color[3]);
    uniforms.metallic = material.metallicFactor;
    uniforms.roughness = material.roughnessFactor;
    uniforms.baseColorPlace = placeOf(material.baseColor);
    uniforms.metallicRoughnessPlace = placeOf(material.metallicRoughness);
    uniforms.trimPlace = placeOf(material.trim);
    const bool ownTrim = material.trimDomain != SUPPLE_TRIM_NONE && material.trimAlpha == 0;
    // A mask without a texture is a trim too: of the alphas that multiply a white one.
    const bool mask = material.alphaMode == SUPPLE_ALPHA_MASK && !ownTrim;
    const auto set = [&](bool yes, uint32_t flag) { uniforms.flags |= yes ? flag : 0; };
    set(material.doubleSided != 0, shared::kMaterialDoubleSided);
    set(mask, shared::kMaterialMask | shared::kMaterialTrim | shared::kMaterialTrimAlpha);
    set(material.alphaMode == SUPPLE_ALPHA_BLEND, shared::kMaterialTranslucent);
    set(uv1 && material.baseColor.uvSet == 1, shared::kMaterialUv1);
    set(material.metallicRoughness.image != SUPPLE_NO_IMAGE, shared::kMaterialMetallicRoughness);
    set(uv1 && material.metallicRoughness.uvSet == 1, shared::kMaterialMetallicRoughnessUv1);
    set(ownTrim, shared::kMaterialTrim);
    set(uv1 && material.trim.uvSet == 1, shared::kMaterialTrimUv1);
    set(material.trimDomain == SUPPLE_TRIM_FACE, shared::kMaterialTrimFace);
    uniforms.cutoff = ownTrim ? material.trimCutoff : material.alphaCutoff;
    uniforms.trimChannel = ownTrim ? material.trimChannel : 3;
    uniforms.trimTiles = static_cast<float>(std::max(material.trimTiles, 1u));
    return uniforms;
}

} // namespace supple::host
