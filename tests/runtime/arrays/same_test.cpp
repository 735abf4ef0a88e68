// A character that is handed over as arrays is the character that the file is, to the bit.
#include "cage/formats/reader.h"
#include "cage/gltf/reader.h"
#include "runtime/api/descriptions.h"
#include "runtime/arrays/character_arrays.h"
#include "tests/cage/gltf/layered.h"
#include "tests/support/character_arrays.h"
#include "tests/support/meshes.h"
#include "tests/support/same_character.h"
#include "tests/support/sample_assets.h"
#include "tests/support/shared_assets.h"

#include <cstring>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <iterator>
#include <numeric>
#include <supple/supple.hpp>

namespace supple::test {
namespace {

using Strings = std::vector<std::string>;

constexpr Overlooked kOfArrays{true, true, true};

/// All characters, and files that have what these lack: unnormalised weights, all interpolations, many parts.
Strings allFiles() {
    Strings paths = allCharacters();
    for (const char* folder : {"khronos", "whole"}) {
        const Strings files = filesBelow(sharedFolder() + folder, {".glb", ".gltf"});
        if (files.empty()) {
            std::printf("all files of %s%s left out: it is not present\n", sharedFolder().c_str(), folder);
        }
        paths.insert(paths.end(), files.begin(), files.end());
    }
    return paths;
}

cage::Character readFile(const std::string& path, bool sewParts) {
    cage::GltfOptions options;
    options.sewParts = sewParts;
    Result<cage::Character> character = cage::readGltfFile(path, options);
    EXPECT_TRUE(character.ok()) << (character.ok() ? "" : character.error().message);
    return character.ok() ? std::move(*character) : cage::Character{};
}

/// Handed over as arrays.
cage::Character throughArrays(const cage::Character& from, bool sewParts) {
    const CharacterArrays arrays(from);
    Result<cage::Character> character =
        runtime::characterFromArrays(arrays.desc, from.name, {sewParts, cage::NormalCreases::never, false});
    EXPECT_TRUE(character.ok()) << (character.ok() ? "" : character.error().message);
    return character.ok() ? std::move(*character) : cage::Character{};
}

void expectTellsArrays(const cage::Character& character) {
    for (const cage::Part& part : character.parts) {
        EXPECT_EQ(part.polygonSource, cage::PolygonSource::arrays);
        EXPECT_EQ(part.weldSource, cage::WeldSource::given);
    }
    std::vector<uint32_t> numbers(character.cage.vertexCount());
    std::iota(numbers.begin(), numbers.end(), 0u);
    EXPECT_EQ(character.cage.sourceVertices, numbers);
    EXPECT_EQ(character.sourceVertexCount, character.cage.vertexCount());
    EXPECT_EQ(character.seamVertexCount, 0u);
    EXPECT_TRUE(character.damages.empty());
}

/// What a change of a character is called.
Strings differencesOf(const cage::Character& character, const std::function<void(cage::Character&)>& change) {
    cage::Character changed = character;
    change(changed);
    return CharacterDifferences(character, changed).found();
}

TEST(CharacterDifferences, AreFoundInWhatMovesBesideSkinTargetsAndClips) {
    using cage::Character;
    Character character = readFile(kPip, false);
    character.weights.jiggles.resize(character.cage.vertexCount());
    character.weights.cloths.resize(character.cage.vertexCount());
    character.weights.jiggles[3] = {0, 0.5f};
    character.weights.cloths[7] = {0, 1.0f};
    character.jiggles.resize(1);
    character.cloths.resize(1);
    character.expressions.resize(1);
    character.drivers.resize(1);
    character.springBones = {{cage::Spring{}}, {{0}}, {cage::SpringCollider{}}};
    character.springBones.springs[0].joints.resize(2);
    EXPECT_EQ(differencesOf(character, [](Character&) {}), Strings());
    const auto expect = [&](const char* name, const std::function<void(Character&)>& change) {
        EXPECT_EQ(differencesOf(character, change), Strings{name});
    };
    expect("weights.jiggles[3]", [](Character& c) { c.weights.jiggles[3].weight = 0.25f; });
    expect("weights.cloths[7]", [](Character& c) { c.weights.cloths[7] = {}; });
    expect("jiggles[0]", [](Character& c) { c.jiggles[0].frequency = 2.0f; });
    expect("jiggles.size()", [](Character& c) { c.jiggles.clear(); });
    expect("cloths[0]", [](Character& c) { c.cloths[0].volume = true; });
    expect("cloths[0]", [](Character& c) { c.cloths[0].colliders = {0}; });
    expect("expressions[0].weights.size()", [](Character& c) { c.expressions[0].weights = {1.0f}; });
    expect("drivers[0]", [](Character& c) { c.drivers[0].width = 1.0f; });
    expect("springBones.springs[0].joints[1]", [](Character& c) { c.springBones.springs[0].joints[1].drag = 0.75f; });
    expect("springBones.colliderGroups", [](Character& c) { c.springBones.colliderGroups[0].clear(); });
    expect("springBones.colliders[0].radius", [](Character& c) { c.springBones.colliders[0].radius = -0.0f; });
    expect("materialVariants.size()", [](Character& c) { c.materialVariants = {"blue"}; });
}

TEST(CharacterArrays, AreTheCharacterOfTheFile) {
    const Strings paths = allFiles();
    ASSERT_FALSE(paths.empty());
    for (const std::string& path : paths) {
        SCOPED_TRACE(path);
        const cage::Character apart = readFile(path, false);
        ASSERT_GT(apart.cage.faceCount(), 0u);
        const cage::Character handed = throughArrays(apart, false);
        EXPECT_EQ(CharacterDifferences(apart, handed, kOfArrays).found(), Strings());
        expectTellsArrays(handed);
    }
}

TEST(CharacterArrays, HaveAllLayersOfMaterials) {
    const Result<cage::Character> file = cage::readGltf(layeredQuad().glb(), "layered.glb", "");
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_EQ(CharacterDifferences(*file, throughArrays(*file, false), kOfArrays).found(), Strings());
    CharacterArrays arrays(*file);
    SuppleAssetDesc desc{};
    desc.structSize = sizeof desc;
    desc.name = "layered.glb";
    desc.character = &arrays.desc;
    // A host that knows the layers of the first version.
    constexpr size_t kFirst = offsetof(SuppleMaterialLayers, diffuseTransmissionFactor);
    std::vector<std::byte> firstLayers(file->materials.size() * kFirst);
    for (size_t i = 0; i < file->materials.size(); ++i) {
        SuppleMaterialLayers layers = arrays.desc.materialLayers[i];
        layers.structSize = kFirst;
        std::memcpy(firstLayers.data() + i * kFirst, &layers, kFirst);
    }
    arrays.desc.materialLayers = reinterpret_cast<const SuppleMaterialLayers*>(firstLayers.data());
    const Result<cage::Character> first = api::readAsset("suppleCreateAsset", desc);
    ASSERT_TRUE(first.ok()) << first.error().message;
    cage::MaterialLayers known = file->materials[0].layers;
    const cage::MaterialLayers none;
    known.diffuseTransmissionFactor = known.thicknessFactor = known.attenuationDistance = 0.0f;
    known.diffuseTransmissionColorFactor = known.attenuationColor = none.attenuationColor;
    known.diffuseTransmissionTexture = known.diffuseTransmissionColorTexture = known.thicknessTexture = {};
    EXPECT_TRUE(first->materials[0].layers == known);
    // A host that knows no layers.
    arrays.desc.structSize = offsetof(SuppleCharacterDesc, materialLayers);
    const Result<cage::Character> old = api::readAsset("suppleCreateAsset", desc);
    ASSERT_TRUE(old.ok()) << old.error().message;
    EXPECT_TRUE(old->materials[0].layers == none);
}

TEST(CharacterArrays, AreSewnAsTheFileIs) {
    for (const std::string& path : allFiles()) {
        SCOPED_TRACE(path);
        const cage::Character file = readFile(path, true);
        if (file.parts.size() > 1) {
            const cage::Character handed = throughArrays(readFile(path, false), true);
            EXPECT_EQ(CharacterDifferences(file, handed, kOfArrays).found(), Strings());
        }
    }
}

/// None of those files has parts that are sewn together.
TEST(CharacterArrays, AreSewnWhereBoundariesCoincide) {
    const float positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0};
    const uint32_t count = 4, left[] = {0, 1, 2, 3}, right[] = {0, 2, 3, 1};
    const uint32_t joint = 0;
    const auto skin = [&] {
        auto desc = sized<SuppleSkinDesc>();
        desc.jointCount = 1;
        desc.joints = &joint;
        return desc;
    }();
    const uint32_t joints[] = {0, 0, 0, 0};
    const float weights[] = {1, 1, 1, 1};
    const float rightPositions[] = {1, 0, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0};
    SuppleCageDesc cages[] = {sized<SuppleCageDesc>(), sized<SuppleCageDesc>()};
    SupplePartDesc parts[] = {sized<SupplePartDesc>(), sized<SupplePartDesc>()};
    SuppleNodeDesc nodes[] = {sized<SuppleNodeDesc>(), sized<SuppleNodeDesc>()};
    for (uint32_t p = 0; p < 2; ++p) {
        cages[p].vertexCount = 4;
        cages[p].faceCount = 1;
        cages[p].positions = p == 0 ? positions : rightPositions;
        cages[p].faceVertexCounts = &count;
        cages[p].faceVertexIndices = p == 0 ? left : right;
        parts[p].node = p;
        parts[p].cage = &cages[p];
        parts[p].skin = &skin;
        parts[p].influences = {nullptr, 1, joints, weights};
        nodes[p].parent = SUPPLE_NO_NODE;
    }
    auto desc = sized<SuppleCharacterDesc>();
    desc.nodeCount = desc.partCount = 2;
    desc.nodes = nodes;
    desc.parts = parts;
    for (const bool sewParts : {true, false}) {
        const Result<cage::Character> read =
            runtime::characterFromArrays(desc, "pair", {sewParts, cage::NormalCreases::never, false});
        ASSERT_TRUE(read.ok()) << read.error().message;
        EXPECT_EQ(read->cage.vertexCount(), sewParts ? 6u : 8u);
        EXPECT_EQ(read->seamVertexCount, sewParts ? 2u : 0u);
        EXPECT_EQ(read->parts.size(), 2u);
        EXPECT_TRUE(read->parts[0].rigid);
    }
}

/// One way in: what reads OBJ files, too.
TEST(CharacterArrays, AreTheMeshOfAnObjFile) {
    const Strings paths = filesBelow(sharedFolder() + "meshes", {".obj"});
    if (paths.empty()) {
        std::printf("all shared OBJ files left out: %smeshes is not present\n", sharedFolder().c_str());
    }
    for (const std::string& path : paths) {
        SCOPED_TRACE(path);
        const Result<cage::Character> file = readObjFile(path);
        ASSERT_TRUE(file.ok()) << file.error().message;
        const cage::Character handed = throughArrays(*file, true);
        EXPECT_EQ(CharacterDifferences(*file, handed, kOfArrays).found(), Strings());
    }
}

const runtime::Prepared& preparedOf(const Prepared& prepared) {
    return *prepared.handle()->prepared;
}

void addLine(SuppleSeverity severity, SuppleMessage message, const char* text, void* user) {
    (void)message;
    if (severity == SUPPLE_SEVERITY_ERROR) {
        static_cast<Strings*>(user)->emplace_back(text);
    }
}

/// All that the public interface builds before there is a device.
Prepared prepare(const SuppleAssetDesc& asset, Strings& errors) {
    std::vector<SuppleGroupDesc> descs;
    for (const SuppleScheme scheme :
         {SUPPLE_SCHEME_AUTO, SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_POLYGONS}) {
        auto desc = sized<SuppleGroupDesc>();
        desc.scheme = scheme;
        desc.flags = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_TANGENTS;
        desc.rate = 4;
        desc.poseSource = SUPPLE_POSES_PLAYBACK;
        descs.push_back(desc);
    }
    std::vector<SupplePlannedGroup> groups;
    for (const SuppleGroupDesc& desc : descs) {
        groups.push_back({&desc, 0, 0});
    }
    auto desc = sized<SupplePrepareDesc>();
    desc.asset = &asset;
    desc.groups = groups.data();
    desc.groupCount = static_cast<uint32_t>(groups.size());
    desc.log = addLine;
    desc.logUser = &errors;
    Prepared prepared;
    EXPECT_EQ(Prepared::create(desc, prepared), SUPPLE_OK) << (errors.empty() ? "" : errors.front());
    return prepared;
}

/// What lies on the device of it: the same words.
TEST(CharacterArrays, HaveTheTablesOfTheFile) {
    for (const std::string& path : {kPip, kWren}) {
        SCOPED_TRACE(path);
        std::ifstream file(path, std::ios::binary);
        const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        auto asset = sized<SuppleAssetDesc>();
        asset.name = "character";
        asset.bytes = bytes.data();
        asset.byteCount = bytes.size();
        Strings errors;
        const Prepared ofFile = prepare(asset, errors);
        const cage::Character apart = readFile(path, false);
        const CharacterArrays arrays(apart);
        asset.bytes = nullptr;
        asset.byteCount = 0;
        asset.character = &arrays.desc;
        const Prepared ofArrays = prepare(asset, errors);
        ASSERT_TRUE(ofFile.handle() != nullptr && ofArrays.handle() != nullptr);
        const runtime::Prepared &a = preparedOf(ofFile), &b = preparedOf(ofArrays);
        EXPECT_EQ(CharacterDifferences(a.character, b.character, kOfArrays).found(), Strings());
        EXPECT_EQ(a.deform.words, b.deform.words);
        ASSERT_TRUE(a.clips && b.clips);
        EXPECT_EQ(a.clips->words, b.clips->words);
        ASSERT_EQ(a.tables.size(), b.tables.size());
        ASSERT_GE(a.tables.size(), 3u);
        for (size_t t = 0; t < a.tables.size(); ++t) {
            EXPECT_TRUE(a.tables[t]->tables.words == b.tables[t]->tables.words) << t;
        }
    }
}

} // namespace
} // namespace supple::test
