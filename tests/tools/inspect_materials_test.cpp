// supple inspect --json against what the JSON of the files says, read here a second way: field by field, for every
// material and image of every sample and shared asset.
#include "tests/support/shared_assets.h"
#include "tests/tools/command_runner.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

using Json = nlohmann::json;

/// The JSON of a .gltf or of a .glb's first chunk.
Json documentOf(const std::string& path) {
    const std::string bytes = supple::test::readText(path);
    if (bytes.rfind("glTF", 0) != 0) {
        return Json::parse(bytes);
    }
    uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    return Json::parse(bytes.substr(20, length));
}

/// JSON's numbers are doubles, Supple's are floats.
Json asFloats(Json value) {
    if (value.is_array()) {
        for (Json& part : value) {
            part = asFloats(part);
        }
        return value;
    }
    return value.is_number() ? Json(value.get<float>()) : value;
}

void expectNumber(const Json& from, const char* key, Json fallback, const Json& told, const char* toldAs = nullptr) {
    EXPECT_EQ(asFloats(told.at(toldAs != nullptr ? toldAs : key)), asFloats(from.value(key, std::move(fallback))))
        << key;
}

std::string wrapName(int value) {
    return value == 33071 ? "CLAMP_TO_EDGE" : value == 33648 ? "MIRRORED_REPEAT" : "REPEAT";
}

std::string filterName(const Json& sampler, const char* key) {
    if (!sampler.contains(key)) {
        return "ANY";
    }
    constexpr std::array kMipmapped{"NEAREST_MIPMAP_NEAREST", "LINEAR_MIPMAP_NEAREST", "NEAREST_MIPMAP_LINEAR",
                                    "LINEAR_MIPMAP_LINEAR"};
    const int value = sampler[key];
    return value == 9728 ? "NEAREST" : value == 9729 ? "LINEAR" : kMipmapped.at(static_cast<size_t>(value - 9984));
}

/// The files that are compared hold all their images, in formats of the core, and use two UV sets at most.
void expectTexture(const Json& gltf, const Json& owner, const char* key, const Json& toldMaterial) {
    SCOPED_TRACE(key);
    const Json& told = toldMaterial.at(key);
    ASSERT_EQ(told.is_null(), !owner.contains(key));
    if (told.is_null()) {
        return;
    }
    const Json& info = owner[key];
    const Json& texture = gltf["textures"][info["index"].get<size_t>()];
    EXPECT_EQ(told["image"], texture["source"]);
    EXPECT_TRUE(told["alternateImage"].is_null());
    const Json sampler =
        texture.contains("sampler") ? gltf["samplers"][texture["sampler"].get<size_t>()] : Json::object();
    EXPECT_EQ(told["wrap"], Json::array({wrapName(sampler.value("wrapS", 0)), wrapName(sampler.value("wrapT", 0))}));
    EXPECT_EQ(told["magFilter"], filterName(sampler, "magFilter"));
    EXPECT_EQ(told["minFilter"], filterName(sampler, "minFilter"));
    const Json transform = info.value("extensions", Json::object()).value("KHR_texture_transform", Json::object());
    EXPECT_EQ(told["uvSet"], transform.value("texCoord", info.value("texCoord", 0)));
    expectNumber(transform, "offset", {0.0, 0.0}, told);
    expectNumber(transform, "rotation", 0.0, told);
    expectNumber(transform, "scale", {1.0, 1.0}, told);
}

/// What the file says of layers. What it leaves out is told too.
void expectLayers(const Json& gltf, const Json& extensions, const Json& layers) {
    for (const auto& [name, told] : layers.items()) {
        ASSERT_TRUE(extensions.contains(name)) << name;
        for (const auto& [key, value] : extensions[name].items()) {
            SCOPED_TRACE(name + " " + key);
            ASSERT_TRUE(told.contains(key));
            if (value.is_object()) {
                expectTexture(gltf, extensions[name], key.c_str(), told);
            } else {
                EXPECT_EQ(asFloats(told[key]), asFloats(value));
            }
        }
    }
}

void expectMaterial(const Json& gltf, const Json& from, const Json& told) {
    EXPECT_EQ(told["name"], from.value("name", ""));
    EXPECT_EQ(told["alphaMode"], from.value("alphaMode", "OPAQUE"));
    expectNumber(from, "alphaCutoff", 0.5, told);
    EXPECT_EQ(told["doubleSided"], from.value("doubleSided", false));
    const Json extensions = from.value("extensions", Json::object());
    EXPECT_EQ(told["unlit"], extensions.contains("KHR_materials_unlit"));
    const Json pbr = from.value("pbrMetallicRoughness", Json::object());
    expectNumber(pbr, "baseColorFactor", {1.0, 1.0, 1.0, 1.0}, told);
    expectNumber(pbr, "metallicFactor", 1.0, told);
    expectNumber(pbr, "roughnessFactor", 1.0, told);
    expectNumber(from, "emissiveFactor", {0.0, 0.0, 0.0}, told);
    expectNumber(extensions.value("KHR_materials_emissive_strength", Json::object()), "emissiveStrength", 1.0, told);
    expectNumber(from.value("normalTexture", Json::object()), "scale", 1.0, told, "normalScale");
    expectNumber(from.value("occlusionTexture", Json::object()), "strength", 1.0, told, "occlusionStrength");
    expectTexture(gltf, pbr, "baseColorTexture", told);
    expectTexture(gltf, pbr, "metallicRoughnessTexture", told);
    expectTexture(gltf, from, "normalTexture", told);
    expectTexture(gltf, from, "occlusionTexture", told);
    expectTexture(gltf, from, "emissiveTexture", told);
    const Json extras = from.value("extras", Json::object());
    const bool ownTrim = extras.is_object() && extras.contains("trim");
    const bool mask = from.value("alphaMode", "") == "MASK" && pbr.contains("baseColorTexture");
    EXPECT_EQ(told.contains("trim"), ownTrim || mask);
    expectLayers(gltf, extensions, told.value("layers", Json::object()));
    const size_t more = (ownTrim || mask ? 1u : 0u) + (told.contains("layers") ? 1u : 0u);
    EXPECT_EQ(told.size(), 17u + more) << "fields that are compared nowhere";
}

class InspectMaterials : public supple::test::CommandTest {
protected:
    /// How many materials and textures were compared.
    struct Compared {
        size_t files = 0;
        size_t materials = 0;
        size_t textures = 0;
    };

    Compared compare(const std::vector<std::string>& paths) {
        Compared compared;
        for (const std::string& path : paths) {
            SCOPED_TRACE(path);
            const supple::test::Outcome outcome = run("inspect '" + path + "' --json");
            if (outcome.exitCode != 0) {
                EXPECT_EQ(outcome.exitCode, 1) << "refused, and not for its materials";
                EXPECT_EQ(outcome.err.find("material"), std::string::npos) << outcome.err;
                continue;
            }
            const Json told = Json::parse(outcome.out);
            const Json gltf = documentOf(path);
            const Json materials = gltf.value("materials", Json::array());
            EXPECT_EQ(told["materials"].size(), materials.size());
            EXPECT_EQ(told["images"].size(), gltf.value("images", Json::array()).size());
            for (size_t i = 0; i < materials.size() && i < told["materials"].size(); ++i) {
                SCOPED_TRACE("material " + std::to_string(i));
                expectMaterial(gltf, materials[i], told["materials"][i]);
                for (const Json& field : told["materials"][i]) {
                    compared.textures += field.is_object() && field.contains("uvSet") ? 1 : 0;
                }
            }
            ++compared.files;
            compared.materials += materials.size();
        }
        return compared;
    }
};

TEST_F(InspectMaterials, AreWhatTheSamplesSay) {
    const Compared compared = compare(supple::test::filesBelow(SUPPLE_SAMPLE_ASSETS, {".glb", ".gltf"}));
    EXPECT_GE(compared.files, 3u);
    EXPECT_GE(compared.materials, 5u);
}

TEST_F(InspectMaterials, AreWhatTheSharedAssetsSay) {
    std::vector<std::string> paths;
    for (const char* folder : {"characters", "khronos", "whole"}) {
        const std::vector<std::string> found =
            supple::test::filesBelow(supple::test::sharedFolder() + folder, {".glb", ".gltf"});
        paths.insert(paths.end(), found.begin(), found.end());
    }
    if (paths.empty()) {
        GTEST_SKIP() << "no shared assets in " << supple::test::sharedFolder();
    }
    const Compared compared = compare(paths);
    std::printf("%zu of %zu files, %zu materials with %zu textures\n", compared.files, paths.size(), compared.materials,
                compared.textures);
    EXPECT_GE(compared.files, 20u);
    EXPECT_GE(compared.textures, 5u);
}

} // namespace
