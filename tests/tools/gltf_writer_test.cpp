#include "tools/gltf/writer.h"

#include "cage/formats/reader.h"
#include "cage/material_layers.h"
#include "cage/obj/reader.h"
#include "cage/polygons.h"
#include "tests/cage/gltf/builder.h"
#include "tests/support/characters.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

namespace supple::cage {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::expectSame;
using test::toBytes;
using Strings = std::vector<std::string>;
using Integers = std::vector<uint32_t>;

/// A GLB taken apart without the reader's help.
class Glb {
public:
    explicit Glb(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {
        EXPECT_EQ(word(0), 0x46546C67u);
        EXPECT_EQ(word(1), 2u);
        EXPECT_EQ(word(2), bytes_.size());
        const uint32_t length = word(3);
        EXPECT_EQ(length % 4, 0u);
        EXPECT_EQ(word(4), 0x4E4F534Au);
        const char* text = reinterpret_cast<const char*>(bytes_.data()) + 20;
        root = json::parse(text, text + length);
        binary_ = 20 + length + 8;
        EXPECT_EQ(word((20 + length) / 4), bytes_.size() - binary_);
        EXPECT_EQ(word((24 + length) / 4), 0x004E4942u);
        EXPECT_EQ(root["buffers"][0]["byteLength"], bytes_.size() - binary_);
    }

    [[nodiscard]] const json& primitive(size_t index) const { return root["meshes"][0]["primitives"][index]; }
    [[nodiscard]] const json& extension(size_t index) const {
        return primitive(index)["extensions"]["SUPPLE_mesh_cage"];
    }
    [[nodiscard]] Integers integers(const json& accessor) const { return values<uint32_t>(accessor); }
    [[nodiscard]] std::vector<float> floats(const json& accessor) const { return values<float>(accessor); }

    json root;

private:
    [[nodiscard]] uint32_t word(size_t index) const {
        uint32_t value = 0;
        std::memcpy(&value, bytes_.data() + 4 * index, 4);
        return value;
    }

    template <class T>
    [[nodiscard]] std::vector<T> values(const json& index) const {
        const json& accessor = root["accessors"][index.get<size_t>()];
        const json& view = root["bufferViews"][accessor["bufferView"].get<size_t>()];
        const std::string type = accessor["type"];
        const size_t width = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
        const int component = accessor["componentType"];
        const size_t size = component == 5121 ? 1 : component == 5123 ? 2 : 4;
        EXPECT_EQ(component == 5126, (std::is_same_v<T, float>));
        std::vector<T> list(accessor["count"].get<size_t>() * width, T{});
        EXPECT_EQ(view["byteLength"], list.size() * size);
        const std::byte* from = bytes_.data() + binary_ + view["byteOffset"].get<size_t>();
        for (T& value : list) {
            std::memcpy(&value, from, size);
            from += size;
        }
        return list;
    }

    std::vector<std::byte> bytes_;
    size_t binary_ = 0;
};

std::vector<std::byte> writeWell(const Character& character, const Strings& warnings = {}) {
    Result<GlbFile> file = writeGlb(character);
    EXPECT_TRUE(file.ok()) << file.error().message;
    if (!file.ok()) {
        return {};
    }
    EXPECT_EQ(file->warnings, warnings);
    return std::move(file->bytes);
}

Character readWell(const std::vector<std::byte>& bytes, const std::string& name = "t.glb") {
    Result<Character> result = readCharacter(bytes, name, "");
    EXPECT_TRUE(result.ok()) << result.error().message;
    return result.ok() ? std::move(result.value()) : Character{};
}

Character readObjWell(const std::string& text) {
    return readWell(toBytes(text), "t.obj");
}

std::vector<std::byte> onePixelPng() {
    const unsigned char bytes[] = {0x89, 'P',  'N',  'G',  0x0D, 0x0A, 0x1A, 0x0A, 0,    0,    0,    0x0D, 'I',  'H',
                                   'D',  'R',  0,    0,    0,    1,    0,    0,    0,    1,    8,    6,    0,    0,
                                   0,    0x1F, 0x15, 0xC4, 0x89, 0,    0,    0,    0x0D, 'I',  'D',  'A',  'T',  0x78,
                                   0xDA, 0x63, 0x64, 0x60, 0xF8, 0x5F, 0x0F, 0,    2,    0x87, 1,    0x80, 0xEB, 0x47,
                                   0xBA, 0x92, 0,    0,    0,    0,    'I',  'E',  'N',  'D',  0xAE, 0x42, 0x60, 0x82};
    const auto view = std::as_bytes(std::span(bytes));
    return {view.begin(), view.end()};
}

/// Five faces over a grid of nine vertices, with something of everything that a character can have.
Character richCharacter() {
    Character c;
    c.name = "rich.glb";
    c.copyright = "nobody";
    Cage& cage = c.cage;
    for (int v = 0; v < 9; ++v) {
        cage.positions.emplace_back(v % 3, v / 3, 0.25f * static_cast<float>(v * v % 5));
    }
    cage.faceStarts = {0, 4, 8, 12, 15, 18};
    cage.faceVertices = {0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 7, 6, 4, 5, 8, 4, 8, 7};
    cage.faceMaterials = {0, 0, 1, 1, kNone};
    for (uint32_t corner = 0; corner < 18; ++corner) {
        const glm::vec3 p = cage.positions[cage.faceVertices[corner]];
        const float chart = corner >= 4 && corner < 8 ? 0.5f : 0.0f; // the second face is cut off
        cage.cornerUvs.emplace_back(p.x / 4 + chart, p.y / 4);
        cage.cornerUvs1.emplace_back(p.y, -p.x);
        cage.cornerColors.emplace_back(0.0f, 513 / 65535.0f, 1.0f, corner < 12 ? 1.0f : 0.0f);
    }
    cage.creaseSets = {"ridge", "edge"};
    cage.creases = {{1, 4, 10.0f, kNone}, {3, 4, 2.5f, 0}, {4, 8, 1.0f, 1}};
    cage.creaseScalars = {{4, 3, 0.3f}, {3, 4, 0.0f}, {8, 4, 1.0f}};
    cage.sharpVertices = {{4, 3.0f}, {8, 10.0f}};
    cage.holes = {1, 3};

    c.skeleton.nodes.resize(9);
    c.skeleton.nodes[0].name = "mesh";
    for (uint32_t n = 1; n < 9; ++n) {
        Node& node = c.skeleton.nodes[n];
        node.name = "joint " + std::to_string(n);
        node.parent = n == 1 ? kNone : n / 2;
        node.translation = {0.5f * static_cast<float>(n), 0.0f, -1.0f};
    }
    c.skeleton.nodes[2].rotation = glm::quat(0.6f, 0.0f, 0.8f, 0.0f);
    c.skeleton.nodes[2].scale = {1.0f, 2.0f, 0.5f};
    c.skeleton.nodes[8] = {};
    c.skeleton.nodes[8].parent = 4;
    c.skeleton.nodes[8].hasMatrix = true;
    c.skeleton.nodes[8].matrix[3] = {1.0f, 2.0f, 3.0f, 1.0f};
    c.skeleton.parentsFirst = {0, 1, 2, 3, 4, 5, 6, 7, 8};
    c.skin.joints = {8, 1, 2, 3, 4, 5};
    c.skin.inverseBinds.assign(6, glm::mat4(1.0f));
    c.skin.inverseBinds[2][3] = {-1.0f, 0.5f, 0.125f, 1.0f};
    c.weights.starts = {0};
    for (uint32_t v = 0; v < 9; ++v) {
        const uint32_t count = v == 4 ? 6 : 1 + v % 2;
        for (uint32_t k = 0; k < count; ++k) {
            c.weights.influences.push_back({v == 4 ? k : v % 3 + 3 * k, 1.0f / static_cast<float>(count)});
        }
        c.weights.starts.push_back(static_cast<uint32_t>(c.weights.influences.size()));
    }

    c.morphs.targets = {{"one", {4}, {{0, 0, 1}}},
                        {"most", {0, 1, 2, 3, 4, 5, 6, 7}, std::vector<glm::vec3>(8, {0.5f, -1, 0})},
                        {"", {}, {}}};
    c.morphs.weights = {0.25f, 0.0f, 1.0f};
    c.parts[0].targetCount = 3;
    c.parts[0].skinning = SkinningMode::deltaMush;
    c.parts[0].smoothing = Smoothing{0.5f, 8};
    c.weights.mushMask = {1, 0.5f, 0, 1, 1, 0.25f, 1, 0, 1};
    c.parts[0].name = c.skeleton.nodes[c.parts[0].node].name;

    c.clips.resize(2);
    c.clips[0].name = "all";
    c.clips[0].duration = 2.0;
    c.clips[0].channels = {{2, ChannelPath::translation, Interpolation::linear, {0, 1, 2}, {0, 0, 0, 1, 2, 3, 4, 5, 6}},
                           {3, ChannelPath::rotation, Interpolation::step, {0.5f, 2}, {0, 0, 0, 1, 0, 0.6f, 0, 0.8f}},
                           {2, ChannelPath::scale, Interpolation::linear, {1}, {1, 1, 2}},
                           {0, ChannelPath::weights, Interpolation::linear, {0, 1, 2}, {0, 1, 0, 0.5f, 0, 0, 1, 0, 1}}};
    c.clips[1].name = "splines";
    c.clips[1].duration = 1.0;
    c.clips[1].channels = {
        {2, ChannelPath::rotation, Interpolation::cubicSpline, {0, 1}, {0, 0, 0, 0, 0, 0, 0,    1,    1, 0, 0, 0,
                                                                        0, 2, 0, 0, 0, 0, 0.6f, 0.8f, 0, 0, 0, 0}},
        {0, ChannelPath::weights, Interpolation::cubicSpline, {0, 1}, std::vector<float>(18, 0.5f)}};
    c.clips[0].markers = {{"step", 0.0}, {"", 0.1}, {"step", 2.0}};

    c.materials.resize(2);
    c.materials[0].name = "painted";
    c.materials[0].baseColorTexture = {.image = 1,
                                       .uvSet = 1,
                                       .wrapU = Wrap::clampToEdge,
                                       .wrapV = Wrap::mirroredRepeat,
                                       .magFilter = Filter::nearest,
                                       .minFilter = Filter::linearMipmapNearest,
                                       .offset = {0.25f, -1.0f},
                                       .rotation = 0.5f,
                                       .scale = {2.0f, 0.75f}};
    c.materials[0].metallicRoughnessTexture = {.image = 1, .alternateImage = 2, .minFilter = Filter::linear};
    c.materials[0].metallicFactor = 0.25f;
    c.materials[0].roughnessFactor = 0.75f;
    c.materials[0].normalTexture = {.image = 3, .offset = {0.5f, 0.0f}};
    c.materials[0].normalScale = -2.0f;
    c.materials[0].occlusionTexture = {.image = 1};
    c.materials[0].occlusionStrength = 0.5f;
    c.materials[0].emissiveTexture = {.image = 2};
    c.materials[0].emissiveFactor = {1.0f, 0.5f, 0.25f};
    c.materials[0].emissiveStrength = 8.0f;
    c.materials[1].unlit = true;
    c.materials[0].alphaMode = AlphaMode::mask;
    c.materials[0].alphaCutoff = 0.25f;
    c.materials[0].doubleSided = true;
    c.materials[1].baseColorFactor = {0.1f, 0.2f, 0.3f, 0.4f};
    c.materials[1].alphaMode = AlphaMode::blend;
    c.materials[0].trim = {.texture = {.image = 1, .uvSet = 1, .wrapU = Wrap::clampToEdge, .scale = {3.0f, 3.0f}},
                           .channel = 2,
                           .cutoff = 0.375f};
    c.materials[1].trim = {
        .domain = TrimDomain::face, .texture = {.image = 1}, .channel = 3, .cutoff = 0.25f, .tiles = 5};
    cage.faceTrimTiles = {kNone, kNone, 4, kNone, kNone};
    c.images = {{"unused", "image/png", onePixelPng()},
                {"pixel", "image/png", onePixelPng()},
                {"small", "image/webp", toBytes("RIFF....WEBP")},
                {"compressed", "image/ktx2", toBytes("\xABKTX 20\xBB")}};
    return c;
}

TEST(GltfWriter, EverythingComesBack) {
    const Character character = richCharacter();
    const std::vector<std::byte> bytes = writeWell(character);
    const Character again = readWell(bytes);
    EXPECT_EQ(again.warnings, Strings());
    EXPECT_EQ(again.parts[0].polygonSource, PolygonSource::cageExtension);
    EXPECT_EQ(again.parts[0].weldSource, WeldSource::cageExtension);
    expectSame(character, again);
    EXPECT_EQ(again.images.size(), 3u) << "what no material uses is left out";
    EXPECT_TRUE(writeWell(again) == bytes) << "a file that was written is written again byte by byte";
}

TEST(GltfWriter, LayersOfMaterialsComeBack) {
    Character character = richCharacter();
    MaterialLayers& layers = character.materials[1].layers;
    float number = 0.125f;
    for (const LayerNumber& row : kLayerNumbers) {
        layers.*row.member = row.low + number; // none is the usual one
        number += 0.0625f;
    }
    layers.anisotropyRotation = -0.5f;
    layers.sheenColorFactor = {1.0f, 0.5f, 0.25f};
    layers.specularColorFactor = {2.0f, 0.5f, 0.25f};
    layers.diffuseTransmissionColorFactor = {1.0f, 0.5f, 0.0f};
    layers.attenuationColor = {0.25f, 0.5f, 0.0f};
    for (const LayerTexture& row : kLayerTextures) {
        layers.*row.member = {.image = 1};
    }
    layers.clearcoatNormalScale = 3.0f;
    layers.transmissionTexture.uvSet = 1;
    layers.ior = 1.25f;
    const std::vector<std::byte> bytes = writeWell(character);
    const Character again = readWell(bytes);
    EXPECT_EQ(again.warnings, Strings());
    expectSame(character, again);
    EXPECT_TRUE(writeWell(again) == bytes);
    const json used = Glb(bytes).root["extensionsUsed"];
    for (const char* extension : kLayerExtensions) {
        EXPECT_NE(std::find(used.begin(), used.end(), json(extension)), used.end()) << extension;
    }
}

TEST(GltfWriter, SharpnessOfClipsComesBack) {
    Character character = richCharacter();
    Channel keys;
    keys.path = ChannelPath::weights;
    keys.times = {0.0f, 0.25f, 1.5f};
    keys.values = {0.0f, 4.0f, -0.25f};
    character.clips[0].sharpness = {{"ridge", keys}};
    keys.interpolation = Interpolation::step;
    character.clips[0].sharpness.push_back({"gone", keys});
    const Character again = readWell(writeWell(character));
    EXPECT_EQ(again.warnings, Strings());
    ASSERT_EQ(again.clips[0].sharpness.size(), 2u);
    EXPECT_EQ(again.clips[0].sharpness[0].set, "ridge");
    EXPECT_EQ(again.clips[0].sharpness[0].keys.times, keys.times);
    EXPECT_EQ(again.clips[0].sharpness[0].keys.values, keys.values);
    EXPECT_EQ(again.clips[0].sharpness[1].keys.interpolation, Interpolation::step);
    EXPECT_EQ(again.clips[0].duration, std::max(character.clips[0].duration, 1.5));
}

TEST(GltfWriter, PoseDriversComeBack) {
    const Result<Character> arm = readGltfFile(std::string(SUPPLE_TEST_DATA) + "/drivers/arm.glb");
    ASSERT_TRUE(arm.ok()) << arm.error().message;
    Character character = *arm;
    ASSERT_EQ(character.drivers.size(), 2u);
    character.drivers[0].inputs.push_back({.node = 2, .part = TurnPart::rotation, .weight = 0.25f});
    character.drivers[0].poses.insert(character.drivers[0].poses.begin() + 1, glm::vec4(0, 0, 0, 1));
    character.drivers[0].poses.insert(character.drivers[0].poses.begin() + 3, glm::vec4(0, 1, 0, 0));
    character.drivers[0].poses.push_back(glm::vec4(1, 0, 0, 0));
    character.drivers[0].width = 1.5f;
    character.drivers[0].low = -0.25f;
    const std::vector<std::byte> bytes = writeWell(character);
    const Result<Character> again = readGltf(bytes, "arm.glb", "", {.strict = true});
    ASSERT_TRUE(again.ok()) << again.error().message;
    EXPECT_EQ(again->drivers, character.drivers);
    EXPECT_EQ(again->warnings, std::vector<std::string>());
    EXPECT_TRUE(Glb(bytes).root["extensionsUsed"].dump().find("SUPPLE_deformers") != std::string::npos);
}

TEST(GltfWriter, JigglesComeBack) {
    const Result<Character> belly = readGltfFile(std::string(SUPPLE_TEST_DATA) + "/jiggle/belly.glb", {.strict = true});
    ASSERT_TRUE(belly.ok()) << belly.error().message;
    Character character = *belly;
    ASSERT_EQ(character.jiggles, (std::vector<Jiggle>{{2.5f, 0.12f, 0.12f}}));
    character.jiggles.push_back({7.0f, 0.5f, 0.25f});
    character.weights.jiggles[5] = {1, 0.75f};
    const std::vector<std::byte> bytes = writeWell(character);
    const Result<Character> again = readGltf(bytes, "belly.glb", "", {.strict = true});
    ASSERT_TRUE(again.ok()) << again.error().message;
    EXPECT_EQ(again->jiggles, character.jiggles);
    EXPECT_EQ(again->weights.jiggles, character.weights.jiggles);
    EXPECT_EQ(again->warnings, std::vector<std::string>());
}

TEST(GltfWriter, ClothsComeBack) {
    const Result<Character> caped = readGltfFile(std::string(SUPPLE_TEST_DATA) + "/cloth/caped.glb", {.strict = true});
    ASSERT_TRUE(caped.ok()) << caped.error().message;
    Character character = *caped;
    ASSERT_EQ(character.cloths.size(), 1u);
    Cloth& own = character.cloths[0];
    EXPECT_EQ(own.colliders, (std::vector<uint32_t>{0, 1}));
    EXPECT_EQ(own.hitRadius, 0.015f);
    own = {1e-6f, 2e-6f, 5e-3f, true, 1.25f, 0.25f, 0.5f, 4.5f, 0.03125f, 3, {1, 0}};
    SpringCollider plane;
    plane.node = character.springBones.colliders.at(0).node;
    plane.shape = ColliderShape::plane;
    plane.tail = {0.0f, 1.0f, 0.0f};
    character.springBones.colliders.push_back(plane);
    character.weights.cloths[character.cage.vertexCount() - 1].weight = 0.75f;
    const std::vector<std::byte> bytes = writeWell(character);
    const Result<Character> again = readGltf(bytes, "caped.glb", "", {.strict = true});
    ASSERT_TRUE(again.ok()) << again.error().message;
    EXPECT_EQ(again->cloths, character.cloths);
    EXPECT_EQ(again->weights.cloths, character.weights.cloths);
    ASSERT_EQ(again->springBones.colliders.size(), 3u);
    for (size_t i = 0; i < 3; ++i) {
        const SpringCollider &is = again->springBones.colliders[i], &was = character.springBones.colliders[i];
        EXPECT_EQ(is.node, was.node);
        EXPECT_EQ(is.shape, was.shape);
        EXPECT_EQ(is.tail, was.tail);
        EXPECT_EQ(is.radius, was.radius);
    }
    EXPECT_EQ(again->warnings, std::vector<std::string>());
}

TEST(GltfWriter, SpringsComeBack) {
    Character character = richCharacter();
    const auto springNode = [&](uint32_t parent, const glm::vec3& translation) {
        Node node;
        node.name = "spring" + std::to_string(character.skeleton.nodes.size());
        node.parent = parent;
        node.translation = translation;
        character.skeleton.parentsFirst.push_back(static_cast<uint32_t>(character.skeleton.nodes.size()));
        character.skeleton.nodes.push_back(node);
        return character.skeleton.parentsFirst.back();
    };
    const uint32_t top = springNode(0, {0, 1, 0}), middle = springNode(top, {0, 1, 0}),
                   end = springNode(middle, {1, 0, 0});
    SpringBones& bones = character.springBones;
    SpringCollider capsule{.node = 0, .shape = ColliderShape::capsule};
    capsule.offset = {1.0f, 2.0f, 3.0f};
    capsule.tail = {4.0f, 5.0f, 6.0f};
    capsule.radius = 0.5f;
    SpringCollider sphere{.node = top, .inside = true};
    sphere.radius = 9.0f;
    bones.colliders = {capsule, sphere};
    bones.colliderGroups = {{1}, {0, 1}};
    bones.springs.resize(1);
    bones.springs[0].name = "ear";
    bones.springs[0].center = 0;
    bones.springs[0].joints = {{top, 0.02f, 2.0f, 0.1f, 0.4f, {0, 0, -1}}, {middle}, {end}};
    bones.springs[0].colliderGroups = {1, 0};
    const Result<Character> again = readGltf(writeWell(character), "t.glb", "", {.strict = true});
    ASSERT_TRUE(again.ok()) << again.error().message;
    ASSERT_EQ(again->springBones.springs.size(), 1u);
    const Spring &is = again->springBones.springs[0], &was = bones.springs[0];
    EXPECT_EQ(is.name, was.name);
    EXPECT_EQ(is.center, was.center);
    EXPECT_FALSE(is.isTree);
    EXPECT_EQ(is.colliderGroups, was.colliderGroups);
    ASSERT_EQ(is.joints.size(), was.joints.size());
    for (size_t j = 0; j < is.joints.size(); ++j) {
        EXPECT_EQ(is.joints[j].node, was.joints[j].node);
        EXPECT_EQ(is.joints[j].hitRadius, was.joints[j].hitRadius);
        EXPECT_EQ(is.joints[j].stiffness, was.joints[j].stiffness);
        EXPECT_EQ(is.joints[j].gravityPower, was.joints[j].gravityPower);
        EXPECT_EQ(is.joints[j].gravityDirection, was.joints[j].gravityDirection);
        EXPECT_EQ(is.joints[j].drag, was.joints[j].drag);
    }
    EXPECT_EQ(again->springBones.colliderGroups, bones.colliderGroups);
    ASSERT_EQ(again->springBones.colliders.size(), 2u);
    for (size_t i = 0; i < 2; ++i) {
        const SpringCollider &here = again->springBones.colliders[i], &there = bones.colliders[i];
        EXPECT_EQ(here.node, there.node);
        EXPECT_EQ(here.shape, there.shape);
        EXPECT_EQ(here.inside, there.inside);
        EXPECT_EQ(here.offset, there.offset);
        EXPECT_EQ(here.tail, there.tail);
        EXPECT_EQ(here.radius, there.radius);
    }
}

TEST(GltfWriter, BranchesOfVrm0BecomeChains) {
    Character character = richCharacter();
    const auto first = static_cast<uint32_t>(character.skeleton.nodes.size());
    // A root with two branches; the second one is a leaf.
    const uint32_t parents[] = {0, first, first + 1, first};
    for (size_t i = 0; i < 4; ++i) {
        Node node;
        node.name = "bone" + std::to_string(i);
        node.parent = parents[i];
        node.translation = {0.0f, 2.0f, 0.0f};
        character.skeleton.parentsFirst.push_back(first + static_cast<uint32_t>(i));
        character.skeleton.nodes.push_back(node);
    }
    Spring tree;
    tree.isTree = true;
    for (uint32_t i = 0; i < 4; ++i) {
        tree.joints.push_back({.node = first + i, .stiffness = 0.25f, .drag = 0.75f});
    }
    character.springBones.springs = {tree};
    const Result<Character> again = readGltf(writeWell(character), "t.glb", "", {.strict = true});
    ASSERT_TRUE(again.ok()) << again.error().message;
    const std::vector<Spring>& springs = again->springBones.springs;
    ASSERT_EQ(springs.size(), 2u);
    ASSERT_EQ(springs[0].joints.size(), 4u);
    ASSERT_EQ(springs[1].joints.size(), 2u);
    const uint32_t chain[] = {first, first + 1, first + 2};
    for (size_t j = 0; j < 3; ++j) {
        EXPECT_EQ(springs[0].joints[j].node, chain[j]);
        EXPECT_EQ(springs[0].joints[j].stiffness, 0.25f);
        EXPECT_EQ(springs[0].joints[j].drag, 0.75f);
    }
    EXPECT_EQ(springs[1].joints[0].node, first + 3);
    for (const Spring& spring : springs) {
        const Node& tail = again->skeleton.nodes[spring.joints.back().node];
        EXPECT_EQ(tail.parent, spring.joints[spring.joints.size() - 2].node);
        EXPECT_NEAR(tail.translation.y, 0.07f, 1e-6f) << "what VRM 0.x gives a leaf";
    }
}

TEST(GltfWriter, RefusesACharacterWithoutFaces) {
    Character character;
    character.name = "nobody";
    EXPECT_EQ(writeGlb(character).error().message, "nobody: GLB: there are no faces to write");
    character.parts.clear();
    EXPECT_EQ(writeGlb(character).error().message, "nobody: GLB: there are no faces to write");
}

TEST(GltfWriter, TheExtensionByHand) {
    const Glb glb(writeWell(richCharacter()));
    EXPECT_EQ(glb.root["extensionsUsed"], json({"FB_ngon_encoding", "SUPPLE_mesh_cage", "SUPPLE_deformers",
                                                "EXT_texture_webp", "KHR_materials_emissive_strength",
                                                "KHR_materials_unlit", "KHR_texture_basisu", "KHR_texture_transform"}));
    EXPECT_EQ(glb.root["meshes"][0]["extensions"],
              json({{"SUPPLE_deformers",
                     {{"skinning", "deltaMush"},
                      {"smoothing", {{"lambda", 0.5}, {"iterations", 8}, {"mask", "_SUPPLE_MUSH"}}}}}}));
    EXPECT_EQ(glb.root["extensionsRequired"], json({"EXT_texture_webp", "KHR_texture_basisu"}))
        << "textures with nothing but these";
    ASSERT_EQ(glb.root["meshes"][0]["primitives"].size(), 3u);
    EXPECT_EQ(glb.primitive(0)["material"], 0);
    EXPECT_EQ(glb.primitive(1)["material"], 1);
    EXPECT_FALSE(glb.primitive(2).contains("material"));

    // Faces 0 1 4 3 and 1 2 5 4; their charts part 1 from 1 and 4 from 4, and so does the hard crease between them.
    const json& first = glb.extension(0);
    EXPECT_EQ(glb.integers(first["faceVertexCounts"]), (Integers{4, 4}));
    EXPECT_EQ(glb.integers(first["cageVertices"]), (Integers{0, 1, 1, 2, 3, 4, 4, 5}));
    EXPECT_EQ(glb.integers(first["faceVertexIndices"]), (Integers{0, 1, 5, 4, 2, 3, 7, 6}));
    EXPECT_EQ(glb.integers(first["creaseIndices"]), (Integers{1, 4, 3, 4}));
    EXPECT_EQ(glb.floats(first["creaseSharpnesses"]), (std::vector<float>{10.0f, 2.5f}));
    EXPECT_EQ(glb.integers(first["cornerIndices"]), (Integers{4}));
    EXPECT_EQ(glb.floats(first["cornerSharpnesses"]), (std::vector<float>{3.0f}));
    EXPECT_EQ(glb.integers(first["holeIndices"]), (Integers{1}));
    EXPECT_EQ(first["creaseSets"].size(), 1u);
    EXPECT_EQ(first["creaseSets"][0]["name"], "ridge");
    EXPECT_EQ(glb.integers(first["creaseSets"][0]["creases"]), (Integers{1}));
    EXPECT_EQ(glb.integers(first["creaseScalarIndices"]), (Integers{4, 3, 3, 4}));
    EXPECT_EQ(glb.floats(first["creaseScalars"]), (std::vector<float>{0.3f, 0.0f}));
    EXPECT_EQ(first.size(), 11u);

    // A crease is written once, where both its ends are first; holes count within the primitive.
    const json& second = glb.extension(1);
    EXPECT_EQ(glb.integers(second["faceVertexCounts"]), (Integers{4, 3}));
    EXPECT_EQ(glb.integers(second["creaseIndices"]), (Integers{4, 8}));
    EXPECT_EQ(second["creaseSets"][0]["name"], "edge");
    EXPECT_EQ(glb.integers(second["creaseScalarIndices"]), (Integers{8, 4}));
    EXPECT_EQ(glb.integers(second["cornerIndices"]), (Integers{8}));
    EXPECT_EQ(glb.integers(second["holeIndices"]), (Integers{1}));
    const json& third = glb.extension(2);
    EXPECT_EQ(third.size(), 3u);

    for (size_t p = 0; p < 3; ++p) {
        for (const auto& [key, accessor] : glb.extension(p).items()) {
            if (accessor.is_array()) {
                continue;
            }
            const json& description = glb.root["accessors"][accessor.get<size_t>()];
            EXPECT_EQ(description["type"], "SCALAR") << key;
            EXPECT_FALSE(glb.root["bufferViews"][description["bufferView"].get<size_t>()].contains("target")) << key;
        }
        // Every polygon is also there as a fan.
        const Integers triangles = glb.integers(glb.primitive(p)["indices"]);
        const Integers cageVertices = glb.integers(glb.extension(p)["cageVertices"]);
        Integers vertices(cageVertices.size());
        for (uint32_t v = 0; v < vertices.size(); ++v) {
            vertices[v] = v;
        }
        EXPECT_EQ(decodeNgons(triangles, vertices).faceCount(),
                  glb.integers(glb.extension(p)["faceVertexCounts"]).size());
        EXPECT_TRUE(std::is_sorted(cageVertices.begin(), cageVertices.end())) << "vertices keep the cage's order";
    }
}

TEST(GltfWriter, ViewersGetUnitNormalsThatSplitAtHardCreases) {
    const std::string cube = "v -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 -1\nv 1 -1 -1\n"
                             "f 1 2 4 3\nf 3 4 6 5\nf 5 6 8 7\nf 7 8 2 1\nf 2 8 6 4\nf 7 1 3 5\n";
    const auto normals = [](const Glb& glb) { return glb.floats(glb.primitive(0)["attributes"]["NORMAL"]); };
    const Glb smooth(writeWell(readObjWell(cube)));
    ASSERT_EQ(normals(smooth).size(), 3 * 8u);
    for (const float component : normals(smooth)) {
        EXPECT_NEAR(std::abs(component), std::sqrt(1.0f / 3.0f), 1e-6f);
    }
    // The front face cut out: its corners face front, those behind it the mean of two sides.
    const Glb cut(writeWell(readObjWell(cube + "t crease 5/1/0 0 1 3 2 0 10\n")));
    const std::vector<float> n = normals(cut);
    const Integers cageVertices = cut.integers(cut.extension(0)["cageVertices"]);
    ASSERT_EQ(n.size(), 3 * 12u);
    size_t facingFront = 0;
    for (size_t v = 0; v < 12; ++v) {
        EXPECT_NEAR(n[3 * v] * n[3 * v] + n[3 * v + 1] * n[3 * v + 1] + n[3 * v + 2] * n[3 * v + 2], 1.0f, 1e-6f);
        facingFront += n[3 * v + 2] == 1.0f ? 1 : 0;
        if (cageVertices[v] < 4 && n[3 * v + 2] != 1.0f) {
            EXPECT_NEAR(n[3 * v + 2], 0.0f, 1e-6f);
        }
    }
    EXPECT_EQ(facingFront, 4u);
}

TEST(GltfWriter, MaterialsMayAlternate) {
    const std::string grid = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 3 1 0\n"
                             "usemtl a\nf 1 2 6 5\nusemtl b\nf 2 3 7 6\nusemtl a\nf 3 4 8 7\nt hole 1/0/0 2\n"
                             "t crease 2/1/0 1 5 4\nt crease 2/1/0 2 6 11\n";
    const Character character = readObjWell(grid);
    const Character again = readWell(writeWell(character));
    EXPECT_EQ(again.cage.faceMaterials, (Integers{0, 0, 1}));
    expectSame(character, again);
}

TEST(GltfWriter, TexturesGetTheCoordinatesTheyName) {
    Character character = readObjWell("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl m\nf 1 2 3 4\n");
    character.images = {{"", "", onePixelPng()}};
    character.materials[0].baseColorTexture = {.image = 0, .uvSet = 1};
    const Glb glb(writeWell(character));
    EXPECT_EQ(glb.floats(glb.primitive(0)["attributes"]["TEXCOORD_0"]), std::vector<float>(8, 0.0f));
    EXPECT_EQ(glb.floats(glb.primitive(0)["attributes"]["TEXCOORD_1"]), std::vector<float>(8, 0.0f));
    EXPECT_EQ(glb.root["images"][0]["mimeType"], "image/png");

    character.images[0].bytes = toBytes("GIF89a");
    const Glb without(writeWell(character, {"image 0: is neither PNG, JPEG, WebP nor KTX2; left out"}));
    EXPECT_FALSE(without.root.contains("images"));
    EXPECT_FALSE(without.root.contains("textures"));
}

TEST(GltfWriter, SaysWhatItLeavesOut) {
    Character character = richCharacter();
    character.clips.push_back({"still", 0.0, {}, {}});
    character.cage.creases.push_back({0, 99, 3.0f});
    character.cage.creaseScalars = {{0, 8, 0.5f}};
    character.clips[1].channels[0].values[7] = 2.0f; // a key that is no unit quaternion
    const Glb glb(writeWell(character, {"creases: 1 crease or sharp vertex is not on a face of the cage; left out",
                                        "creases: 1 crease scalar is not on a face of the cage; left out",
                                        "clip \"splines\": 1 key rotation of splines normalised",
                                        "clip \"still\": has no channels; left out"}));
    EXPECT_EQ(glb.root["animations"].size(), 2u);
}

TEST(GltfWriter, StillMeshesHaveTheCharactersMaterials) {
    const Character character = richCharacter();
    StillFaces faces;
    faces.material = 0;
    faces.positions = {{0, 0, 0}, {2, 0, 0}, {0, 3, -1}};
    faces.normals.assign(3, glm::vec3(0, 0, 1));
    faces.triangles = {0, 1, 2};
    const std::vector<StillMesh> meshes{{"one", {faces}}, {"", {faces}}};
    const Result<GlbFile> file = writeGlb(character, meshes);
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_EQ(file->vertexCount, 6u);
    EXPECT_EQ(file->warnings, Strings{"material 1: its trim lies on faces of the cage; left out"});
    const Glb still(file->bytes);
    EXPECT_EQ(still.root["nodes"], json::parse(R"([{"name": "one", "mesh": 0}, {"mesh": 1}])"));
    EXPECT_EQ(still.root["asset"]["copyright"], "nobody");
    const json& attributes = still.primitive(0)["attributes"];
    EXPECT_EQ(attributes.size(), 4u);
    EXPECT_EQ(still.floats(attributes["TEXCOORD_1"]), std::vector<float>(6, 0.0f)) << "a texture names it";
    EXPECT_EQ(still.root["accessors"][attributes["POSITION"].get<size_t>()]["max"], json({2.0, 3.0, 0.0}));

    const std::vector<std::byte> whole = writeWell(character);
    json materials = Glb(whole).root["materials"];
    materials[1].erase("extras");
    EXPECT_EQ(still.root["materials"], materials);
    for (const char* list : {"textures", "samplers", "images"}) {
        EXPECT_EQ(still.root[list].size(), Glb(whole).root[list].size()) << list;
    }
    EXPECT_EQ(readWell(file->bytes).images[1].bytes, character.images[2].bytes);
    EXPECT_EQ(writeGlb(character, {}).error().message, "rich.glb: GLB: there are no faces to write");
}

TEST(GltfWriter, JointsGetACommonRoot) {
    Character character = richCharacter();
    character.skeleton.nodes[2].parent = kNone;
    const Glb glb(writeWell(character, {"skin: 2 roots above its joints; a node is put above them all"}));
    EXPECT_EQ(glb.root["nodes"].size(), 10u);
    EXPECT_EQ(glb.root["nodes"][9]["children"], json({1, 2}));
    EXPECT_EQ(glb.root["scenes"][0]["nodes"], json({0, 9}));
}

TEST(GltfWriter, ManyJointsAndVerticesTakeWiderIntegers) {
    Character character = richCharacter();
    for (uint32_t n = 0; n < 300; ++n) {
        character.skin.joints.push_back(static_cast<uint32_t>(character.skeleton.nodes.size()));
        character.skeleton.nodes.emplace_back().parent = 1;
    }
    character.skin.inverseBinds.resize(306, glm::mat4(1.0f));
    character.weights.influences[0].joint = 299;
    expectSame(character, readWell(writeWell(character)));

    std::string strip;
    for (int i = 0; i < 33000; ++i) {
        strip += "v " + std::to_string(i) + " 0 0\nv " + std::to_string(i) + " 1 0\n";
        strip += i > 0 ? "f -4 -2 -1 -3\n" : "";
    }
    const Character large = readObjWell(strip + "t crease 2/1/0 65997 65999 3\n");
    ASSERT_EQ(large.cage.creases.size(), 1u);
    const std::vector<std::byte> bytes = writeWell(large);
    const Glb glb(bytes);
    for (const char* key : {"faceVertexIndices", "cageVertices", "creaseIndices"}) {
        EXPECT_EQ(glb.root["accessors"][glb.extension(0)[key].get<size_t>()]["componentType"], 5125) << key;
    }
    expectSame(large, readWell(bytes));
}

TEST(GltfWriter, HostileNames) {
    Character character = richCharacter();
    character.name = "two\nlines";
    character.materials[0].name = "\xFF\xFE not UTF-8 \"quoted\"\n";
    const Character again = readWell(writeWell(character));
    EXPECT_NE(again.materials[0].name.find(" not UTF-8 \"quoted\"\n"), std::string::npos);
}

std::vector<std::byte> fileBytes(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return toBytes({std::istreambuf_iterator<char>(stream), {}});
}

TEST(GltfWriter, SharedAssetsComeBack) {
    const fs::path folder = fs::path(SUPPLE_SHARED_DIR) / "assets";
    std::vector<fs::path> paths{fs::path(SUPPLE_SAMPLE_ASSETS) / "pip.glb"};
    if (fs::exists(folder)) {
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            if (std::set<std::string>{".glb", ".gltf", ".obj"}.count(entry.path().extension().string()) != 0) {
                paths.push_back(entry.path());
            }
        }
    } else {
        std::printf("all shared characters and meshes left out: ../shared not present\n");
    }
    std::sort(paths.begin(), paths.end());
    size_t polygons = 0;
    size_t creases = 0;
    for (const fs::path& path : paths) {
        SCOPED_TRACE(path.filename().string());
        const Result<Character> character = readCharacter(fileBytes(path), path.string(), path.parent_path().string());
        ASSERT_TRUE(character.ok()) << character.error().message;
        const Result<GlbFile> file = writeGlb(*character);
        ASSERT_TRUE(file.ok()) << file.error().message;
        const Character again = readWell(file->bytes);
        expectSame(*character, again);
        polygons += again.cage.faceCount();
        creases += again.cage.creases.size();
    }
    std::printf("%zu files: %zu polygons and %zu creases came back\n", paths.size(), polygons, creases);
}

} // namespace
} // namespace supple::cage
