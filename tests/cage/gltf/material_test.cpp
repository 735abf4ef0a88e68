// Materials of a glTF file: every field, glTF's defaults, what is repaired, what is refused.
#include "cage/materials.h"
#include "tests/cage/gltf/reading.h"

#include <gtest/gtest.h>
#include <string>

namespace supple::cage {
namespace {

using namespace test;

const std::string kImages =
    R"("images":[{"uri":"data:image/png;base64,iVBORw0KGgo=","name":"face"},{"uri":"data:;base64,UklGRi4uLi5XRUJQ"},)"
    R"({"uri":"data:;base64,q0tUWCAyMLs="},{"uri":"gone.png"}])";

/// The quad, and the file's materials and textures besides the images above.
GltfBuilder quadWith(const std::string& materials, const std::string& textures = "", const std::string& more = "") {
    GltfBuilder b = skinnedQuad();
    b.more += R"(,"materials":[)" + materials + R"(],"textures":[)" + textures + "]," + kImages + more;
    return b;
}

Material only(const GltfBuilder& b) {
    const Character c = readWell(b);
    EXPECT_EQ(c.materials.size(), 1u);
    return c.materials.empty() ? Material{} : c.materials[0];
}

/// The warnings but for the one of the missing image.
Strings warningsOf(const GltfBuilder& b) {
    Strings warnings = readWell(b).warnings;
    EXPECT_FALSE(warnings.empty());
    EXPECT_EQ(warnings.front().rfind("image 3 uri", 0), 0u) << warnings.front();
    warnings.erase(warnings.begin());
    return warnings;
}

TEST(GltfMaterial, EveryField) {
    const GltfBuilder b = quadWith(
        R"({"name":"skin","alphaMode":"MASK","alphaCutoff":0.25,"doubleSided":true,"pbrMetallicRoughness":)"
        R"({"baseColorFactor":[0.5,1,0,0.75],"baseColorTexture":{"index":0},"metallicFactor":0.125,)"
        R"("roughnessFactor":0.375,"metallicRoughnessTexture":{"index":1,"texCoord":1}},)"
        R"("normalTexture":{"index":2,"scale":-1.5},"occlusionTexture":{"index":3,"strength":0.625},)"
        R"("emissiveTexture":{"index":0,"texCoord":1,"extensions":{"KHR_texture_transform":)"
        R"({"offset":[0.5,-2],"rotation":1.5,"scale":[2,-0.25],"texCoord":0}}},"emissiveFactor":[1,0.5,0.25],)"
        R"("extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":12},"KHR_materials_unlit":{}}})",
        R"({"source":0,"sampler":0},{"source":0,"sampler":1,"extensions":{"EXT_texture_webp":{"source":1}}},)"
        R"({"extensions":{"KHR_texture_basisu":{"source":2}}},{"extensions":{"EXT_texture_webp":{"source":1}}})",
        R"(,"samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9728,"minFilter":9985},{}],"extensionsUsed":)"
        R"(["KHR_texture_transform","KHR_materials_emissive_strength","KHR_materials_unlit"],"extensionsRequired":)"
        R"(["KHR_texture_basisu","EXT_texture_webp","KHR_texture_transform"])");
    EXPECT_EQ(warningsOf(b), Strings());
    const Material m = only(b);
    EXPECT_EQ(m.name, "skin");
    EXPECT_EQ(m.alphaMode, AlphaMode::mask);
    EXPECT_EQ(m.alphaCutoff, 0.25f);
    EXPECT_TRUE(m.doubleSided);
    EXPECT_TRUE(m.unlit);
    EXPECT_EQ(m.baseColorFactor, glm::vec4(0.5f, 1, 0, 0.75f));
    EXPECT_EQ(m.metallicFactor, 0.125f);
    EXPECT_EQ(m.roughnessFactor, 0.375f);
    EXPECT_EQ(m.normalScale, -1.5f);
    EXPECT_EQ(m.occlusionStrength, 0.625f);
    EXPECT_EQ(m.emissiveFactor, glm::vec3(1, 0.5f, 0.25f));
    EXPECT_EQ(m.emissiveStrength, 12.0f);
    Texture sampled{.image = 0,
                    .wrapU = Wrap::clampToEdge,
                    .wrapV = Wrap::mirroredRepeat,
                    .magFilter = Filter::nearest,
                    .minFilter = Filter::linearMipmapNearest};
    EXPECT_TRUE(m.baseColorTexture == sampled);
    EXPECT_TRUE(m.metallicRoughnessTexture == (Texture{.image = 0, .alternateImage = 1, .uvSet = 1}));
    EXPECT_TRUE(m.normalTexture == Texture{.image = 2}) << "an image of an extension alone";
    EXPECT_TRUE(m.occlusionTexture == Texture{.image = 1});
    sampled.offset = {0.5f, -2.0f};
    sampled.rotation = 1.5f;
    sampled.scale = {2.0f, -0.25f};
    EXPECT_TRUE(m.emissiveTexture == sampled) << "the transform's texCoord wins";

    const Character c = readWell(b);
    EXPECT_EQ(c.images[0].mimeType, "image/png");
    EXPECT_EQ(c.images[1].mimeType, "image/webp") << "by its first bytes";
    EXPECT_EQ(c.images[2].mimeType, "image/ktx2");
    EXPECT_EQ(c.images[2].bytes.size(), 8u) << "still encoded";
}

TEST(GltfMaterial, DefaultsAreTheSpecifications) {
    for (const char* material : {"{}", R"({"pbrMetallicRoughness":{}})"}) {
        const Material m = only(quadWith(material));
        EXPECT_EQ(m.name, "");
        EXPECT_EQ(m.alphaMode, AlphaMode::opaque);
        EXPECT_EQ(m.alphaCutoff, 0.5f);
        EXPECT_FALSE(m.doubleSided);
        EXPECT_FALSE(m.unlit);
        EXPECT_EQ(m.baseColorFactor, glm::vec4(1.0f));
        EXPECT_EQ(m.metallicFactor, 1.0f);
        EXPECT_EQ(m.roughnessFactor, 1.0f);
        EXPECT_EQ(m.normalScale, 1.0f);
        EXPECT_EQ(m.occlusionStrength, 1.0f);
        EXPECT_EQ(m.emissiveFactor, glm::vec3(0.0f));
        EXPECT_EQ(m.emissiveStrength, 1.0f);
        for (const Texture* texture : texturesOf(m)) {
            EXPECT_TRUE(*texture == Texture{});
        }
        EXPECT_FALSE(m.trim);
    }
    const Material m = only(quadWith(R"({"normalTexture":{"index":0},"occlusionTexture":{"index":0},)"
                                     R"("extensions":{"KHR_materials_emissive_strength":{}}})",
                                     R"({"source":0})"));
    EXPECT_EQ(m.normalScale, 1.0f);
    EXPECT_EQ(m.occlusionStrength, 1.0f);
    EXPECT_EQ(m.emissiveStrength, 1.0f);
    const Texture plain = m.normalTexture;
    EXPECT_EQ(plain.image, 0u);
    EXPECT_EQ(plain.alternateImage, kNone);
    EXPECT_EQ(plain.uvSet, 0u);
    EXPECT_EQ(plain.wrapU, Wrap::repeat);
    EXPECT_EQ(plain.wrapV, Wrap::repeat);
    EXPECT_EQ(plain.magFilter, Filter::any);
    EXPECT_EQ(plain.minFilter, Filter::any);
    EXPECT_EQ(plain.offset, glm::vec2(0.0f));
    EXPECT_EQ(plain.rotation, 0.0f);
    EXPECT_EQ(plain.scale, glm::vec2(1.0f));
}

TEST(GltfMaterial, EveryFilterAndWrapMode) {
    const std::pair<int, Filter> filters[] = {
        {9728, Filter::nearest},
        {9729, Filter::linear},
        {9984, Filter::nearestMipmapNearest},
        {9985, Filter::linearMipmapNearest},
        {9986, Filter::nearestMipmapLinear},
        {9987, Filter::linearMipmapLinear},
    };
    const std::string material = R"({"emissiveTexture":{"index":0}})";
    for (const auto& [number, filter] : filters) {
        const std::string text = std::to_string(number);
        EXPECT_EQ(only(quadWith(material, R"({"source":0,"sampler":0})", R"(,"samplers":[{"minFilter":)" + text + "}]"))
                      .emissiveTexture.minFilter,
                  filter);
    }
    const Texture linear = only(quadWith(material, R"({"source":0,"sampler":0})",
                                         R"(,"samplers":[{"magFilter":9729,"wrapS":33648,"wrapT":10497}])"))
                               .emissiveTexture;
    EXPECT_EQ(linear.magFilter, Filter::linear);
    EXPECT_EQ(linear.wrapU, Wrap::mirroredRepeat);
    EXPECT_EQ(linear.wrapV, Wrap::repeat);

    const GltfBuilder odd = quadWith(material, R"({"source":0,"sampler":0})",
                                     R"(,"samplers":[{"magFilter":9987,"minFilter":1,"wrapS":10498,"wrapT":0}])");
    EXPECT_EQ(warningsOf(odd),
              (Strings{"sampler 0 wrapS: 10498 is unknown; repeat", "sampler 0 wrapT: 0 is unknown; repeat",
                       "sampler 0 magFilter: 9987 is unknown; left to the host",
                       "sampler 0 minFilter: 1 is unknown; left to the host"}));
    EXPECT_TRUE(only(odd).emissiveTexture == Texture{.image = 0});
}

TEST(GltfMaterial, WhatCannotBeUsedIsLeftOutByName) {
    const GltfBuilder b =
        quadWith(R"({"alphaMode":"GLASS","alphaCutoff":-1,"pbrMetallicRoughness":{"baseColorFactor":[2,-0.5,0,1],)"
                 R"("metallicFactor":1e30,"roughnessFactor":-3,"baseColorTexture":{"index":0,"texCoord":77},)"
                 R"("metallicRoughnessTexture":{"index":1}},"normalTexture":{"index":2},"occlusionTexture":{"index":0,)"
                 R"("strength":1.5,"extensions":{"KHR_texture_transform":{"texCoord":2}}},"emissiveFactor":[0,0,9],)"
                 R"("extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":-2}}})",
                 R"({"source":0},{},{"source":3},{"source":3,"extensions":{"EXT_texture_webp":{"source":1}}})");
    EXPECT_EQ(warningsOf(b),
              (Strings{"material 0 alphaMode: \"GLASS\" is unknown; opaque",
                       "material 0 alphaCutoff: -1 is out of range; 0 taken",
                       "material 0 baseColorFactor[0]: 2 is out of range; 1 taken",
                       "material 0 baseColorFactor[1]: -0.5 is out of range; 0 taken",
                       "material 0 baseColorTexture: texCoord 77: only TEXCOORD_0 and TEXCOORD_1 are read; left out",
                       "material 0 metallicFactor: 1e+30 is out of range; 1 taken",
                       "material 0 roughnessFactor: -3 is out of range; 0 taken",
                       "texture 1: no image in a format that is read; left out",
                       "material 0 occlusionTexture: texCoord 2: only TEXCOORD_0 and TEXCOORD_1 are read; left out",
                       "material 0 occlusionTexture strength: 1.5 is out of range; 1 taken",
                       "material 0 emissiveFactor[2]: 9 is out of range; 1 taken",
                       "material 0 emissiveStrength: -2 is out of range; 0 taken"}));
    const Material m = only(b);
    EXPECT_EQ(m.alphaMode, AlphaMode::opaque);
    EXPECT_EQ(m.baseColorFactor, glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(m.metallicFactor, 1.0f);
    EXPECT_EQ(m.emissiveStrength, 0.0f);
    for (const Texture* texture : texturesOf(m)) {
        EXPECT_TRUE(*texture == Texture{}) << "the missing image has a warning of its own";
    }
    // Of two images for one texture the other one stands in.
    const Material replaced = only(
        quadWith(R"({"normalTexture":{"index":0}})", R"({"source":3,"extensions":{"EXT_texture_webp":{"source":1}}})"));
    EXPECT_TRUE(replaced.normalTexture == Texture{.image = 1});
}

const std::string kSpecularElement = "material 0: KHR_materials_pbrSpecularGlossiness";

/// A material of KHR_materials_pbrSpecularGlossiness alone, or with more. `files`: what stands behind the materials.
GltfBuilder specularQuad(const std::string& members, const std::string& materialMore = "",
                         const std::string& files = "") {
    return quadWith(R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{)" + members + "}}" + materialMore + "}",
                    R"({"source":0},{"source":1})", files);
}

TEST(GltfMaterial, SpecularGlossinessIsConverted) {
    const auto factors = [](const std::string& diffuse, const std::string& specular) {
        return R"("diffuseFactor":)" + diffuse + R"(,"specularFactor":)" + specular + R"(,"glossinessFactor":0.25)";
    };
    const GltfBuilder plain = specularQuad(factors("[0.5,0.25,0.125,0.75]", "[0.02,0.02,0.02]"));
    EXPECT_EQ(warningsOf(plain), (Strings{kSpecularElement + " is converted to metallic and roughness factors"}));
    Material m = only(plain);
    EXPECT_EQ(m.metallicFactor, 0.0f);
    EXPECT_EQ(m.roughnessFactor, 0.75f);
    const glm::vec4 bright(0.5f * 0.98f / 0.96f, 0.25f * 0.98f / 0.96f, 0.125f * 0.98f / 0.96f, 0.75f);
    EXPECT_LT(glm::length(m.baseColorFactor - bright), 1e-6f) << "what is less reflective is brighter below";
    m = only(specularQuad(factors("[0,0,0,1]", "[0.9,0.6,0.3]")));
    EXPECT_NEAR(m.metallicFactor, 1.0f, 1e-5f);
    EXPECT_LT(glm::length(m.baseColorFactor - glm::vec4(0.9f, 0.6f, 0.3f, 1)), 1e-5f) << "the color of a metal";
    m = only(specularQuad(factors("[0.5,0.5,0.5,1]", "[0.3,0.3,0.3]")));
    EXPECT_NEAR(m.metallicFactor, 0.431992f, 1e-5f);
    EXPECT_NEAR(m.baseColorFactor.x, 0.641863f, 1e-5f);
    m = only(specularQuad(""));
    EXPECT_EQ(m.metallicFactor, 1.0f);
    EXPECT_EQ(m.roughnessFactor, 0.0f);
    EXPECT_EQ(m.baseColorFactor, glm::vec4(1.0f));
}

TEST(GltfMaterial, SpecularGlossinessTextures) {
    const GltfBuilder b = specularQuad(R"("diffuseFactor":[0.5,1,1,1],"diffuseTexture":{"index":0,"texCoord":1,)"
                                       R"("extensions":{"ACME_noise":{}}},"specularGlossinessTexture":{"index":1})");
    EXPECT_EQ(warningsOf(b), (Strings{"material 0 diffuseTexture: ACME_noise is not read",
                                      kSpecularElement + " is converted to metallic and roughness factors; its "
                                                         "specularGlossinessTexture is left out"}));
    const Material m = only(b);
    EXPECT_TRUE(m.baseColorTexture == (Texture{.image = 0, .uvSet = 1}));
    EXPECT_FALSE(m.metallicRoughnessTexture.exists());
    EXPECT_EQ(m.baseColorFactor, glm::vec4(0.5f, 1, 1, 1));
    EXPECT_EQ(m.metallicFactor, 0.0f);
    EXPECT_EQ(m.roughnessFactor, 0.5f);
}

/// Metallic and roughness are what is drawn, so they are taken where a file has both and leaves the choice.
TEST(GltfMaterial, SpecularGlossinessBesideMetallicRoughness) {
    const std::string red = R"("diffuseFactor":[1,0,0,1],"specularFactor":[0,0,0])";
    const std::string green = R"(,"pbrMetallicRoughness":{"baseColorFactor":[0,1,0,1]})";
    const GltfBuilder both = specularQuad(red, green);
    EXPECT_EQ(only(both).baseColorFactor, glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(warningsOf(both), (Strings{kSpecularElement + " is not read: pbrMetallicRoughness is taken"}));
    EXPECT_EQ(only(specularQuad(red, R"(,"pbrMetallicRoughness":{})")).baseColorFactor, glm::vec4(1, 0, 0, 1));
    const std::string required = R"(,"extensionsRequired":["KHR_materials_pbrSpecularGlossiness"])";
    EXPECT_EQ(only(specularQuad(red, green, required)).baseColorFactor, glm::vec4(1, 0, 0, 1));
    const GltfBuilder wrong =
        quadWith(R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":7})" + green + "}", "", required);
    EXPECT_EQ(only(wrong).baseColorFactor, glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(warningsOf(wrong), (Strings{"material 0 KHR_materials_pbrSpecularGlossiness: not an object; left out"}));
}

TEST(GltfMaterial, UnreadExtensionsAreNamedOnceAKind) {
    GltfBuilder b =
        quadWith(R"({"extensions":{"KHR_materials_volume_scatter":{},"KHR_materials_dispersion":{"dispersion":1.4}}},)"
                 R"({"extensions":{"KHR_materials_volume_scatter":{"multiscatterColorTexture":{"index":99}}},)"
                 R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"ACME_noise":{}}}}},)"
                 R"({"extensions":{"KHR_materials_volume_scatter":7,"KHR_materials_sheen":{"sheenColorTexture":)"
                 R"({"index":0,"extensions":{"ACME_noise":{}}}}}})",
                 R"({"source":0,"extensions":{"EXT_texture_avif":{"source":0}}})",
                 R"(,"extensionsUsed":["KHR_materials_volume_scatter","KHR_materials_sheen"])");
    EXPECT_EQ(warningsOf(b),
              (Strings{"material 1 baseColorTexture: ACME_noise is not read, here and in 1 other place",
                       "texture 0: EXT_texture_avif is not read", "material 0: KHR_materials_dispersion is not read",
                       "material 0: KHR_materials_volume_scatter is not read, here and in 2 other places"}))
        << "what is declared and not there is nothing to name";
    EXPECT_EQ(messageOf(quadWith("", "", R"(,"extensionsRequired":["KHR_materials_volume_scatter"])")),
              "t.glb: extensionsRequired: KHR_materials_volume_scatter is not supported");
}

TEST(GltfMaterial, LayersAreReadWhole) {
    const GltfBuilder b = quadWith(
        R"({"extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":0.5,"clearcoatTexture":{"index":0},)"
        R"("clearcoatRoughnessFactor":0.25,"clearcoatRoughnessTexture":{"index":0,"texCoord":1},)"
        R"("clearcoatNormalTexture":{"index":0,"scale":2}},"KHR_materials_sheen":{"sheenColorFactor":[1,0.5,0.25],)"
        R"("sheenColorTexture":{"index":0},"sheenRoughnessFactor":0.75,"sheenRoughnessTexture":{"index":0}},)"
        R"("KHR_materials_transmission":{"transmissionFactor":0.875,"transmissionTexture":{"index":0}},)"
        R"("KHR_materials_ior":{"ior":1.25},"KHR_materials_specular":{"specularFactor":0.125,)"
        R"("specularTexture":{"index":0},"specularColorFactor":[2,1,0],"specularColorTexture":{"index":0}},)"
        R"("KHR_materials_iridescence":{"iridescenceFactor":0.5,"iridescenceTexture":{"index":0},)"
        R"("iridescenceIor":1.5,"iridescenceThicknessMinimum":50,"iridescenceThicknessMaximum":600,)"
        R"("iridescenceThicknessTexture":{"index":0}},"KHR_materials_anisotropy":{"anisotropyStrength":0.625,)"
        R"("anisotropyRotation":-1.5,"anisotropyTexture":{"index":0}},"KHR_materials_diffuse_transmission":)"
        R"({"diffuseTransmissionFactor":0.6875,"diffuseTransmissionTexture":{"index":0},)"
        R"("diffuseTransmissionColorFactor":[0.5,0.25,0],"diffuseTransmissionColorTexture":{"index":0}},)"
        R"("KHR_materials_volume":{"thicknessFactor":3,"thicknessTexture":{"index":0},"attenuationDistance":2.5,)"
        R"("attenuationColor":[0.75,0.5,0.25]}}})",
        R"({"source":0})",
        R"(,"extensionsRequired":["KHR_materials_clearcoat","KHR_materials_sheen","KHR_materials_transmission",)"
        R"("KHR_materials_ior","KHR_materials_specular","KHR_materials_iridescence","KHR_materials_anisotropy",)"
        R"("KHR_materials_diffuse_transmission","KHR_materials_volume"])");
    EXPECT_EQ(warningsOf(b), Strings());
    const Texture first{.image = 0};
    MaterialLayers expected;
    expected.clearcoatFactor = 0.5f;
    expected.clearcoatRoughnessFactor = 0.25f;
    expected.clearcoatNormalScale = 2.0f;
    expected.sheenColorFactor = {1, 0.5f, 0.25f};
    expected.sheenRoughnessFactor = 0.75f;
    expected.transmissionFactor = 0.875f;
    expected.ior = 1.25f;
    expected.specularFactor = 0.125f;
    expected.specularColorFactor = {2, 1, 0};
    expected.iridescenceFactor = 0.5f;
    expected.iridescenceIor = 1.5f;
    expected.iridescenceThicknessMinimum = 50.0f;
    expected.iridescenceThicknessMaximum = 600.0f;
    expected.anisotropyStrength = 0.625f;
    expected.anisotropyRotation = -1.5f;
    expected.diffuseTransmissionFactor = 0.6875f;
    expected.diffuseTransmissionColorFactor = {0.5f, 0.25f, 0};
    expected.thicknessFactor = 3;
    expected.attenuationDistance = 2.5f;
    expected.attenuationColor = {0.75f, 0.5f, 0.25f};
    for (const LayerTexture& row : kLayerTextures) {
        expected.*row.member = first;
    }
    expected.clearcoatRoughnessTexture.uvSet = 1;
    EXPECT_TRUE(only(b).layers == expected);
    for (const char* extension : kLayerExtensions) {
        EXPECT_TRUE(hasLayer(expected, extension)) << extension;
        EXPECT_FALSE(hasLayer(MaterialLayers{}, extension)) << extension;
    }
}

TEST(GltfMaterial, WrongLayersAreMendedOrLeftOut) {
    const GltfBuilder b =
        quadWith(R"({"extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":7},"KHR_materials_sheen":3,)"
                 R"("KHR_materials_specular":{"specularColorFactor":[1,2]},"KHR_materials_transmission":)"
                 R"({"transmissionTexture":{"index":9},"transmissionFactor":1}}})",
                 R"({"source":0})");
    EXPECT_EQ(warningsOf(b), (Strings{"material 0 clearcoatFactor: 7 is out of range; 1 taken",
                                      "material 0 KHR_materials_sheen: not an object; left out",
                                      "material 0 transmissionTexture index: texture 9 is out of range: the file has "
                                      "1; left out",
                                      "material 0 specularColorFactor: 2 numbers instead of 3; left out"}));
    const MaterialLayers layers = only(b).layers;
    EXPECT_EQ(layers.clearcoatFactor, 1.0f);
    EXPECT_EQ(layers.transmissionFactor, 1.0f);
    EXPECT_FALSE(layers.transmissionTexture.exists());
    EXPECT_EQ(layers.specularColorFactor, glm::vec3(1.0f));
}

TEST(GltfMaterial, OfTwoFormatsTheWebPIsTheFirstImage) {
    const Material m =
        only(quadWith(R"({"normalTexture":{"index":0},"occlusionTexture":{"index":1}})",
                      R"({"extensions":{"KHR_texture_basisu":{"source":2},"EXT_texture_webp":{"source":1}}},)"
                      R"({"source":0,"extensions":{"KHR_texture_basisu":{"source":2},)"
                      R"("EXT_texture_webp":{"source":1}}})"));
    EXPECT_EQ(m.normalTexture.image, 1u);
    EXPECT_EQ(m.normalTexture.alternateImage, 2u);
    EXPECT_EQ(m.occlusionTexture.image, 0u);
    EXPECT_EQ(m.occlusionTexture.alternateImage, 2u);
}

TEST(GltfMaterial, Refusals) {
    const auto material = [](const std::string& text) { return messageOf(quadWith("{" + text + "}", "{}")); };
    const auto pbr = [&](const std::string& text) { return material(R"("pbrMetallicRoughness":{)" + text + "}"); };
    const auto transform = [&](const std::string& text) {
        return material(R"("normalTexture":{"index":0,"extensions":{"KHR_texture_transform":)" + text + "}}");
    };
    EXPECT_EQ(material(R"("name":7)"), "t.glb: material 0 name: not a string");
    EXPECT_EQ(material(R"("alphaMode":1)"), "t.glb: material 0 alphaMode: not a string");
    EXPECT_EQ(material(R"("alphaCutoff":"x")"), "t.glb: material 0 alphaCutoff: not a finite number");
    EXPECT_EQ(material(R"("doubleSided":1)"), "t.glb: material 0 doubleSided: not a boolean");
    EXPECT_EQ(material(R"("emissiveFactor":[1,1])"), "t.glb: material 0 emissiveFactor: 2 numbers instead of 3");
    EXPECT_EQ(material(R"("emissiveFactor":[1,1,"1"])"), "t.glb: material 0 emissiveFactor: not all numbers");
    EXPECT_EQ(material(R"("pbrMetallicRoughness":[])"), "t.glb: material 0 pbrMetallicRoughness: not an object");
    EXPECT_EQ(pbr(R"("baseColorFactor":[1,1,1])"), "t.glb: material 0 baseColorFactor: 3 numbers instead of 4");
    EXPECT_EQ(pbr(R"("baseColorFactor":[1,1,1,1e300])"), "t.glb: material 0 baseColorFactor: not finite");
    EXPECT_EQ(pbr(R"("metallicFactor":1e300)"), "t.glb: material 0 metallicFactor: not a finite number");
    EXPECT_EQ(pbr(R"("roughnessFactor":[1])"), "t.glb: material 0 roughnessFactor: not a finite number");
    EXPECT_EQ(pbr(R"("baseColorTexture":4)"), "t.glb: material 0 baseColorTexture: not an object");
    EXPECT_EQ(pbr(R"("metallicRoughnessTexture":{})"), "t.glb: material 0 metallicRoughnessTexture: index is missing");
    EXPECT_EQ(material(R"("normalTexture":{"index":1})"),
              "t.glb: material 0 normalTexture index: texture 1 is out of range: the file has 1");
    EXPECT_EQ(material(R"("normalTexture":{"index":0,"scale":true})"),
              "t.glb: material 0 normalTexture scale: not a finite number");
    EXPECT_EQ(material(R"("occlusionTexture":{"index":0,"texCoord":-1})"),
              "t.glb: material 0 occlusionTexture texCoord: -1 is negative");
    EXPECT_EQ(material(R"("emissiveTexture":{"index":0,"texCoord":0.5})"),
              "t.glb: material 0 emissiveTexture texCoord: not an integer");
    EXPECT_EQ(material(R"("extensions":{"KHR_materials_emissive_strength":3})"),
              "t.glb: material 0 KHR_materials_emissive_strength: not an object");
    EXPECT_EQ(transform("[]"), "t.glb: material 0 normalTexture KHR_texture_transform: not an object");
    EXPECT_EQ(transform(R"({"offset":[1]})"),
              "t.glb: material 0 normalTexture KHR_texture_transform offset: 1 numbers instead of 2");
    EXPECT_EQ(transform(R"({"scale":[1,-1e39]})"),
              "t.glb: material 0 normalTexture KHR_texture_transform scale: not finite");
    EXPECT_EQ(transform(R"({"rotation":"a"})"),
              "t.glb: material 0 normalTexture KHR_texture_transform rotation: not a finite number");
    EXPECT_EQ(transform(R"({"texCoord":"a"})"),
              "t.glb: material 0 normalTexture KHR_texture_transform texCoord: not an integer");
    // JSON has no infinity; a number that is none any more is no JSON.
    EXPECT_EQ(pbr(R"("metallicFactor":1e999)").rfind("t.glb: JSON: number overflow", 0), 0u)
        << pbr(R"("metallicFactor":1e999)");
}

TEST(GltfMaterial, RefusalsOfTextures) {
    const auto texture = [](const std::string& text, const std::string& more = "") {
        return messageOf(quadWith("", text, more));
    };
    EXPECT_EQ(texture(R"({"source":4})"), "t.glb: texture 0 source: image 4 is out of range: the file has 4");
    EXPECT_EQ(texture(R"({"sampler":0})"), "t.glb: texture 0 sampler: sampler 0 is out of range: the file has 0");
    EXPECT_EQ(texture(R"({"extensions":{"EXT_texture_webp":{"source":9}}})"),
              "t.glb: texture 0 EXT_texture_webp source: image 9 is out of range: the file has 4");
    EXPECT_EQ(texture(R"({"extensions":{"KHR_texture_basisu":1}})"),
              "t.glb: texture 0 KHR_texture_basisu: not an object");
    EXPECT_EQ(texture("3"), "t.glb: textures 0: not an object");
    EXPECT_EQ(texture("{}", R"(,"samplers":[{"wrapS":"x"}])"), "t.glb: sampler 0 wrapS: not an integer");
    EXPECT_EQ(texture("{}", R"(,"samplers":[{"minFilter":-1}])"), "t.glb: sampler 0 minFilter: -1 is negative");
    GltfBuilder view = skinnedQuad();
    view.more += R"(,"images":[{"bufferView":9}])";
    EXPECT_EQ(messageOf(view), "t.glb: image 0 bufferView: bufferView 9 is out of range: the file has 9");
}

} // namespace
} // namespace supple::cage
