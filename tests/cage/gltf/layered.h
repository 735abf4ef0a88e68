// A file whose first material has all layers that there are, every number and texture, and which has two variants.
#pragma once

#include "tests/cage/gltf/builder.h"

namespace supple::test {

inline GltfBuilder layeredQuad() {
    GltfBuilder b = skinnedQuad();
    const std::string mode = R"("mode":4)";
    b.meshes.replace(b.meshes.find(mode), mode.size(),
                     R"("material":0,"extensions":{"KHR_materials_variants":{"mappings":)"
                     R"([{"variants":[1],"material":1}]}})");
    b.more +=
        R"(,"materials":[{"name":"layered","extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":0.5,)"
        R"("clearcoatTexture":{"index":0},"clearcoatRoughnessFactor":0.25,"clearcoatRoughnessTexture":{"index":1},)"
        R"("clearcoatNormalTexture":{"index":0,"scale":2}},"KHR_materials_sheen":{"sheenColorFactor":[1,0.5,0.25],)"
        R"("sheenColorTexture":{"index":1},"sheenRoughnessFactor":0.75,"sheenRoughnessTexture":{"index":0}},)"
        R"("KHR_materials_transmission":{"transmissionFactor":0.875,"transmissionTexture":{"index":0,"extensions":)"
        R"({"KHR_texture_transform":{"offset":[0.5,-1],"rotation":0.75,"scale":[2,3]}}}},)"
        R"("KHR_materials_ior":{"ior":1.25},"KHR_materials_specular":{"specularFactor":0.125,)"
        R"("specularTexture":{"index":1},"specularColorFactor":[2,1,0],"specularColorTexture":{"index":0}},)"
        R"("KHR_materials_iridescence":{"iridescenceFactor":0.375,"iridescenceTexture":{"index":1},)"
        R"("iridescenceIor":1.625,"iridescenceThicknessMinimum":50,"iridescenceThicknessMaximum":600,)"
        R"("iridescenceThicknessTexture":{"index":0}},"KHR_materials_anisotropy":{"anisotropyStrength":0.625,)"
        R"("anisotropyRotation":-1.5,"anisotropyTexture":{"index":1}},"KHR_materials_diffuse_transmission":)"
        R"({"diffuseTransmissionFactor":0.6875,"diffuseTransmissionTexture":{"index":0},)"
        R"("diffuseTransmissionColorFactor":[0.5,0.25,0],"diffuseTransmissionColorTexture":{"index":1}},)"
        R"("KHR_materials_volume":{"thicknessFactor":0.0625,"thicknessTexture":{"index":0},)"
        R"("attenuationDistance":2.5,"attenuationColor":[0.75,0.5,0.25]}}},{"name":"plain"}],)"
        R"("textures":[{"source":0},{"source":1}],"images":[{"uri":"data:image/png;base64,iVBORw0KGgo="},)"
        R"({"uri":"data:image/png;base64,iVBORw0KGgoA"}],"extensionsUsed":["KHR_materials_variants"],)"
        R"("extensions":{"KHR_materials_variants":{"variants":[{"name":"day"},{"name":"night"}]}})";
    return b;
}

} // namespace supple::test
