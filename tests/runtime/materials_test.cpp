// Materials through the public interface: every field as the file has it, glTF's defaults, and the images behind them.
#include "runtime/material_layers.h"
#include "tests/cage/gltf/layered.h"
#include "tests/support/logged_context.h"

#include <cstring>
#include <gtest/gtest.h>
#include <string>
#include <supple/supple.hpp>
#include <vector>

namespace supple::test {
namespace {

/// A quad with three materials: one of everything, one of nothing, one with a trim of its own.
std::vector<std::byte> paintedQuad() {
    test::GltfBuilder b = test::skinnedQuad();
    b.more +=
        R"(,"materials":[{"name":"all","alphaMode":"MASK","alphaCutoff":0.25,"doubleSided":true,"pbrMetallicRoughness":)"
        R"({"baseColorFactor":[0.5,0.25,0.125,0.75],"baseColorTexture":{"index":0},"metallicFactor":0.375,)"
        R"("roughnessFactor":0.625,"metallicRoughnessTexture":{"index":1,"texCoord":1}},)"
        R"("normalTexture":{"index":1,"scale":2},"occlusionTexture":{"index":1,"strength":0.5},"emissiveTexture":)"
        R"({"index":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,-1],"rotation":0.75,"scale":[2,3]}}},)"
        R"("emissiveFactor":[0.125,0.25,1],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4},)"
        R"("KHR_materials_unlit":{}}},{},{"alphaMode":"BLEND","extras":{"trim":{"texture":{"index":0,"extensions":)"
        R"({"KHR_texture_transform":{"scale":[4,4]}}},"channel":"b","cutoff":0.75}}}],)"
        R"("textures":[{"source":0,"sampler":0},{"source":0,"extensions":{"EXT_texture_webp":{"source":1}}}],)"
        R"("samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9728,"minFilter":9986}],"images":)"
        R"([{"uri":"data:image/png;base64,iVBORw0KGgo=","name":"pixels"},{"uri":"data:;base64,UklGRi4uLi5XRUJQ"}])";
    return b.glb();
}

class MaterialInfo : public testing::Test {
protected:
    void SetUp() override {
        Result<std::unique_ptr<host::Device>> device = host::Device::create({});
        ASSERT_TRUE(device.ok()) << device.error().message;
        device_ = std::move(*device);
        context_ = std::make_unique<LoggedContext>(*device_);
        const std::vector<std::byte> glb = paintedQuad();
        SuppleAssetDesc desc{};
        desc.structSize = sizeof desc;
        desc.name = "quad";
        desc.bytes = glb.data();
        desc.byteCount = glb.size();
        ASSERT_EQ(suppleCreateAsset(context_->handle(), &desc, &asset_), SUPPLE_OK);
    }

    SuppleMaterialInfo material(uint32_t index) {
        SuppleMaterialInfo info;
        std::memset(&info, 0xA5, sizeof info); // everything is written
        info.structSize = sizeof info;
        EXPECT_EQ(suppleGetMaterialInfo(context_->handle(), asset_, index, &info), SUPPLE_OK);
        return info;
    }

    static void expectPlain(const SuppleTextureInfo& texture, uint32_t image) {
        EXPECT_EQ(texture.image, image);
        EXPECT_EQ(texture.alternateImage, SUPPLE_NO_IMAGE);
        EXPECT_EQ(texture.uvSet, 0u);
        EXPECT_EQ(texture.wrap[0], SUPPLE_WRAP_REPEAT);
        EXPECT_EQ(texture.wrap[1], SUPPLE_WRAP_REPEAT);
        EXPECT_EQ(texture.magFilter, SUPPLE_FILTER_ANY);
        EXPECT_EQ(texture.minFilter, SUPPLE_FILTER_ANY);
        expectTransform(texture, {0, 0, 0, 1, 1});
    }

    /// Offset, rotation, scale.
    static void expectTransform(const SuppleTextureInfo& texture, const std::vector<float>& expected) {
        EXPECT_EQ((std::vector<float>{texture.offset[0], texture.offset[1], texture.rotation, texture.scale[0],
                                      texture.scale[1]}),
                  expected);
    }

    static void expectSampled(const SuppleTextureInfo& texture) {
        EXPECT_EQ(texture.image, 0u);
        EXPECT_EQ(texture.wrap[0], SUPPLE_WRAP_CLAMP);
        EXPECT_EQ(texture.wrap[1], SUPPLE_WRAP_MIRROR);
        EXPECT_EQ(texture.magFilter, SUPPLE_FILTER_NEAREST);
        EXPECT_EQ(texture.minFilter, SUPPLE_FILTER_NEAREST_MIPMAP_LINEAR);
    }

    std::unique_ptr<host::Device> device_;
    std::unique_ptr<LoggedContext> context_;
    SuppleAsset asset_{};
};

TEST_F(MaterialInfo, HasEveryFieldOfTheFile) {
    const SuppleMaterialInfo m = material(0);
    EXPECT_STREQ(m.name, "all");
    EXPECT_EQ(m.alphaMode, SUPPLE_ALPHA_MASK);
    EXPECT_EQ(m.alphaCutoff, 0.25f);
    EXPECT_EQ(m.doubleSided, 1u);
    EXPECT_EQ(m.unlit, 1u);
    EXPECT_EQ(std::vector<float>(m.baseColorFactor, m.baseColorFactor + 4),
              (std::vector<float>{0.5f, 0.25f, 0.125f, 0.75f}));
    EXPECT_EQ(m.metallicFactor, 0.375f);
    EXPECT_EQ(m.roughnessFactor, 0.625f);
    EXPECT_EQ(m.normalScale, 2.0f);
    EXPECT_EQ(m.occlusionStrength, 0.5f);
    EXPECT_EQ(std::vector<float>(m.emissiveFactor, m.emissiveFactor + 3), (std::vector<float>{0.125f, 0.25f, 1.0f}));
    EXPECT_EQ(m.emissiveStrength, 4.0f);
    expectSampled(m.baseColor);
    expectTransform(m.baseColor, {0, 0, 0, 1, 1});
    expectSampled(m.emissive);
    expectTransform(m.emissive, {0.5f, -1, 0.75f, 2, 3});
    for (const SuppleTextureInfo* texture : {&m.metallicRoughness, &m.normal, &m.occlusion}) {
        EXPECT_EQ(texture->image, 0u);
        EXPECT_EQ(texture->alternateImage, 1u);
        EXPECT_EQ(texture->uvSet, texture == &m.metallicRoughness ? 1u : 0u);
        EXPECT_EQ(texture->magFilter, SUPPLE_FILTER_ANY);
    }
    // The mask is the trim.
    EXPECT_EQ(m.trimDomain, SUPPLE_TRIM_UV);
    EXPECT_EQ(m.trimChannel, 3u);
    EXPECT_EQ(m.trimCutoff, 0.25f);
    EXPECT_EQ(m.trimFactor, 0.75f);
    EXPECT_EQ(m.trimAlpha, 1u);
    expectSampled(m.trim);
}

TEST_F(MaterialInfo, HasTheDefaultsOfGltf) {
    const SuppleMaterialInfo m = material(1);
    EXPECT_STREQ(m.name, "");
    EXPECT_EQ(m.alphaMode, SUPPLE_ALPHA_OPAQUE);
    EXPECT_EQ(m.alphaCutoff, 0.5f);
    EXPECT_EQ(m.doubleSided, 0u);
    EXPECT_EQ(m.unlit, 0u);
    EXPECT_EQ(std::vector<float>(m.baseColorFactor, m.baseColorFactor + 4), std::vector<float>(4, 1.0f));
    EXPECT_EQ(m.metallicFactor, 1.0f);
    EXPECT_EQ(m.roughnessFactor, 1.0f);
    EXPECT_EQ(m.normalScale, 1.0f);
    EXPECT_EQ(m.occlusionStrength, 1.0f);
    EXPECT_EQ(std::vector<float>(m.emissiveFactor, m.emissiveFactor + 3), std::vector<float>(3, 0.0f));
    EXPECT_EQ(m.emissiveStrength, 1.0f);
    for (const SuppleTextureInfo* texture :
         {&m.baseColor, &m.metallicRoughness, &m.normal, &m.occlusion, &m.emissive, &m.trim}) {
        expectPlain(*texture, SUPPLE_NO_IMAGE);
    }
    EXPECT_EQ(m.trimDomain, SUPPLE_TRIM_NONE);
    EXPECT_EQ(m.trimAlpha, 0u);
}

TEST_F(MaterialInfo, HasTheTrimOfItsOwn) {
    const SuppleMaterialInfo m = material(2);
    EXPECT_EQ(m.alphaMode, SUPPLE_ALPHA_BLEND);
    EXPECT_EQ(m.trimDomain, SUPPLE_TRIM_UV);
    EXPECT_EQ(m.trimChannel, 2u);
    EXPECT_EQ(m.trimCutoff, 0.75f);
    EXPECT_EQ(m.trimFactor, 1.0f);
    EXPECT_EQ(m.trimAlpha, 0u);
    expectSampled(m.trim);
    expectTransform(m.trim, {0, 0, 0, 4, 4});
    expectPlain(m.baseColor, SUPPLE_NO_IMAGE);
}

TEST_F(MaterialInfo, ImagesAreEncodedAndNamed) {
    SuppleImageInfo image{};
    image.structSize = sizeof image;
    ASSERT_EQ(suppleGetImageInfo(context_->handle(), asset_, material(0).baseColor.image, &image), SUPPLE_OK);
    EXPECT_STREQ(image.name, "pixels");
    EXPECT_STREQ(image.mimeType, "image/png");
    EXPECT_EQ(image.byteCount, 8u);
    ASSERT_EQ(suppleGetImageInfo(context_->handle(), asset_, material(0).normal.alternateImage, &image), SUPPLE_OK);
    EXPECT_STREQ(image.mimeType, "image/webp");
    EXPECT_EQ(image.byteCount, 12u);
    EXPECT_EQ(std::memcmp(image.bytes, "RIFF....WEBP", 12), 0);
}

/// layeredQuad() with the materials of a variant.
class LayeredDesc {
public:
    explicit LayeredDesc(const char* variant) : glb_(layeredQuad().glb()) {
        desc_.structSize = sizeof desc_;
        desc_.name = "layered";
        desc_.bytes = glb_.data();
        desc_.byteCount = glb_.size();
        desc_.materialVariant = variant;
    }
    [[nodiscard]] const SuppleAssetDesc* get() const { return &desc_; }

private:
    std::vector<std::byte> glb_;
    SuppleAssetDesc desc_{};
};

SuppleResult createLayered(const LoggedContext& context, const char* variant, SuppleAsset& asset) {
    return suppleCreateAsset(context.handle(), LayeredDesc(variant).get(), &asset);
}

SuppleGroup layeredGroup(const LoggedContext& context, SuppleAsset asset) {
    SuppleGroupDesc desc{};
    desc.structSize = sizeof desc;
    desc.asset = asset;
    desc.capacity = 1;
    desc.scheme = SUPPLE_SCHEME_POLYGONS;
    SuppleGroup group{};
    EXPECT_EQ(suppleCreateGroup(context.handle(), &desc, &group), SUPPLE_OK);
    return group;
}

/// Of the only draw.
uint32_t materialDrawn(const LoggedContext& context, SuppleGroup group) {
    SuppleGridOutput grid{};
    grid.structSize = sizeof grid;
    EXPECT_EQ(suppleGetGridOutput(context.handle(), group, 0, &grid), SUPPLE_OK);
    return grid.drawRangeCount == 1 ? grid.drawRanges[0].material : SUPPLE_NO_MATERIAL;
}

TEST_F(MaterialInfo, LayersHaveEveryFieldOfTheFile) {
    SuppleAsset asset{};
    ASSERT_EQ(createLayered(*context_, nullptr, asset), SUPPLE_OK);
    SuppleMaterialLayers layers;
    std::memset(&layers, 0xA5, sizeof layers);
    layers.structSize = sizeof layers;
    ASSERT_EQ(suppleGetMaterialLayers(context_->handle(), asset, 0, &layers), SUPPLE_OK);
    EXPECT_EQ(layers.clearcoatFactor, 0.5f);
    EXPECT_EQ(layers.clearcoatRoughnessFactor, 0.25f);
    EXPECT_EQ(layers.clearcoatNormalScale, 2.0f);
    EXPECT_EQ(layers.sheenColorFactor[1], 0.5f);
    EXPECT_EQ(layers.sheenRoughnessFactor, 0.75f);
    EXPECT_EQ(layers.transmissionFactor, 0.875f);
    EXPECT_EQ(layers.ior, 1.25f);
    EXPECT_EQ(layers.specularFactor, 0.125f);
    EXPECT_EQ(layers.specularColorFactor[0], 2.0f);
    EXPECT_EQ(layers.iridescenceFactor, 0.375f);
    EXPECT_EQ(layers.iridescenceIor, 1.625f);
    EXPECT_EQ(layers.iridescenceThicknessMinimum, 50.0f);
    EXPECT_EQ(layers.iridescenceThicknessMaximum, 600.0f);
    EXPECT_EQ(layers.anisotropyStrength, 0.625f);
    EXPECT_EQ(layers.anisotropyRotation, -1.5f);
    EXPECT_EQ(layers.diffuseTransmissionFactor, 0.6875f);
    EXPECT_EQ(layers.diffuseTransmissionColorFactor[1], 0.25f);
    EXPECT_EQ(layers.thicknessFactor, 0.0625f);
    EXPECT_EQ(layers.attenuationDistance, 2.5f);
    EXPECT_EQ(layers.attenuationColor[2], 0.25f);
    const uint32_t images[] = {0, 1, 0, 1, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0};
    for (size_t i = 0; i < runtime::kLayerTextureMembers.size(); ++i) {
        EXPECT_EQ((layers.*runtime::kLayerTextureMembers[i]).image, images[i]) << cage::kLayerTextures[i].name;
    }
    expectTransform(layers.transmission, {0.5f, -1, 0.75f, 2, 3});

    ASSERT_EQ(suppleGetMaterialLayers(context_->handle(), asset, 1, &layers), SUPPLE_OK);
    const SuppleMaterialLayers none = defaultMaterialLayers();
    EXPECT_EQ(std::memcmp(&layers, &none, sizeof none), 0) << "a material without any";
}

TEST_F(MaterialInfo, VariantsAreChosenByName) {
    SuppleAsset asset{};
    ASSERT_EQ(createLayered(*context_, "", asset), SUPPLE_OK);
    const char* names[2]{};
    uint32_t count = 1;
    EXPECT_EQ(suppleGetMaterialVariants(context_->handle(), asset, names, &count), SUPPLE_INCOMPLETE);
    EXPECT_EQ(count, 2u);
    EXPECT_EQ(suppleGetMaterialVariants(context_->handle(), asset, names, &count), SUPPLE_OK);
    EXPECT_STREQ(names[0], "day");
    EXPECT_STREQ(names[1], "night");
    const auto drawn = [&](const char* variant) {
        SuppleAsset chosen{};
        EXPECT_EQ(createLayered(*context_, variant, chosen), SUPPLE_OK);
        return materialDrawn(*context_, layeredGroup(*context_, chosen));
    };
    EXPECT_EQ(drawn(nullptr), 0u);
    EXPECT_EQ(drawn("day"), 0u) << "the first primitive has no other material by day";
    EXPECT_EQ(drawn("night"), 1u);
    context_->takeLines();
    EXPECT_EQ(createLayered(*context_, "dusk", asset), SUPPLE_ERROR_ARGUMENT);
    const std::vector<LogLine> lines = context_->takeLines();
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].text.find("no material variant \"dusk\"; it has \"day\", \"night\""), std::string::npos);
}

TEST_F(MaterialInfo, AReloadTakesAnotherVariant) {
    SuppleAsset asset{};
    ASSERT_EQ(createLayered(*context_, "day", asset), SUPPLE_OK);
    const SuppleGroup group = layeredGroup(*context_, asset);
    SuppleInstance instance{};
    ASSERT_EQ(suppleCreateInstance(context_->handle(), group, &instance), SUPPLE_OK);
    EXPECT_EQ(materialDrawn(*context_, group), 0u);

    const auto reload = [&](const char* variant) {
        return suppleReloadAsset(context_->handle(), asset, LayeredDesc(variant).get());
    };
    const auto nameDrawn = [&] {
        SuppleMaterialInfo info{};
        info.structSize = sizeof info;
        EXPECT_EQ(suppleGetMaterialInfo(context_->handle(), asset, materialDrawn(*context_, group), &info), SUPPLE_OK);
        return std::string(info.name);
    };
    ASSERT_EQ(reload("night"), SUPPLE_OK);
    EXPECT_EQ(nameDrawn(), "plain") << "the group is the one that there was";
    EXPECT_EQ(suppleSetVisible(context_->handle(), instance, 0), SUPPLE_OK) << "and so is its instance";
    EXPECT_EQ(reload("dusk"), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(nameDrawn(), "plain") << "nothing has changed";
    ASSERT_EQ(reload(nullptr), SUPPLE_OK);
    EXPECT_EQ(nameDrawn(), "layered") << "the file's own";
    ASSERT_EQ(reload("night"), SUPPLE_OK);
    EXPECT_EQ(nameDrawn(), "plain");
}

} // namespace
} // namespace supple::test
