// What is wrong with a host's arrays is refused, all of it at once, by part, clip or channel and element.
#include "runtime/arrays/character_arrays.h"
#include "tests/support/character_arrays.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/same_character.h"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace supple::test {
namespace {

using Strings = std::vector<std::string>;
using Spoil = std::function<void(CharacterArrays&)>;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// A tube of 8 vertices with two joints, a morph target, a clip of two channels, and a material with an image.
cage::Character tube() {
    TubeOptions options;
    options.segments = 1;
    options.sides = 4;
    options.joints = 2;
    options.morphTargets = 1;
    cage::Character character = riggedTube(options);
    character.name = "tube";
    character.parts[0].joints = {0, 1};
    character.clips = {clipOf({channel(2, cage::ChannelPath::rotation, {0.0f, 1.0f}, {0, 0, 0, 1, 1, 0, 0, 0}),
                               channel(0, cage::ChannelPath::weights, {0.0f, 2.0f}, {0, 1})})};
    character.clips[0].name = "bend";
    character.clips[0].markers = {{"step", 1.0}};
    character.materials.emplace_back().name = "skin";
    character.materials[0].baseColorTexture.image = 0;
    character.images.push_back({"skin", "image/png", std::vector<std::byte>(8)});
    return character;
}

Result<cage::Character> readTube(const Spoil& spoil, const cage::FinishOptions& options = {}) {
    const cage::Character character = tube();
    CharacterArrays arrays(character);
    spoil(arrays);
    return runtime::characterFromArrays(arrays.desc, "tube", options);
}

struct Fault {
    const char* message;
    Spoil spoil;
    ErrorCode code = ErrorCode::asset;
};

void expectFaults(const std::vector<Fault>& faults) {
    for (const Fault& fault : faults) {
        SCOPED_TRACE(fault.message);
        const Result<cage::Character> read = readTube(fault.spoil);
        ASSERT_FALSE(read.ok());
        EXPECT_EQ(read.error().message, std::string("tube: ") + fault.message);
        EXPECT_EQ(read.error().code, fault.code);
    }
}

using Arrays = CharacterArrays;

SuppleCageDesc& cageOf(Arrays& a) {
    return a.partArrays[0].cage;
}

TEST(ArrayFaults, TheTubeIsSound) {
    const Result<cage::Character> read = readTube([](Arrays&) {});
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->warnings, Strings());
    EXPECT_EQ(CharacterDifferences(tube(), *read, {true, true, true}).found(), Strings());
}

TEST(ArrayFaults, OfNodes) {
    static const float kZero[] = {0, 0, 0, 0}, kFar[] = {0, 2e9f, 0, 0};
    static const float kProjective[] = {1, 0, 0, 0.5f, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    expectFaults({
        {"node 1: parent 9 of 3", [](Arrays& a) { a.nodes[1].parent = 9; }},
        {"nodes: 2 nodes are their own ancestors, or below one that is, the first is node 1",
         [](Arrays& a) { a.nodes[1].parent = 2; }},
        {"node 1: translation is beyond 1e+09", [](Arrays& a) { a.nodes[1].translation = kFar; }},
        {"node 2: rotation: zero quaternion", [](Arrays& a) { a.nodes[2].rotation = kZero; }},
        {"node 2: both a matrix and a translation, rotation or scale\ntube: node 2: matrix: last row is not 0 0 0 1"
         "\ntube: clip 0 channel 0: animates node 2, which has a matrix",
         [](Arrays& a) { a.nodes[2].matrix = kProjective; }},
        {"nodes[1].structSize is not that of nodes[0]", [](Arrays& a) { a.nodes[1].structSize -= 4; },
         ErrorCode::structSize},
    });
}

TEST(ArrayFaults, OfParts) {
    static const SuppleSkinDesc kNoJoints{sizeof(SuppleSkinDesc), 0, nullptr, nullptr};
    expectFaults({
        {"parts: none, so there is no surface", [](Arrays& a) { a.desc.partCount = 0; }},
        {"part 0: node 7 of 3", [](Arrays& a) { a.parts[0].node = 7; }},
        {"part 0: no such uvInterpolation or madeFor",
         [](Arrays& a) { a.parts[0].madeFor = static_cast<SuppleMadeFor>(5); }, ErrorCode::range},
        {"part 0: neither cage nor primitives", [](Arrays& a) { a.parts[0].cage = nullptr; }},
        {"part 0: skin: no joints", [](Arrays& a) { a.parts[0].skin = &kNoJoints; }},
        {"part 0: influences without a skin", [](Arrays& a) { a.parts[0].skin = nullptr; }},
        {"part 0: 1 joint is no node: node 3 of 3 in joint 1", [](Arrays& a) { a.partArrays[0].joints[1] = 3; }},
        {"part 0: skin.inverseBinds[1]: not finite", [](Arrays& a) { a.partArrays[0].inverseBinds[20] = kNan; }},
        {"part 0: 1 vertex has no influence: vertex 2",
         [](Arrays& a) { a.partArrays[0].starts[3] = a.partArrays[0].starts[2]; }},
        {"part 0: 1 weight is negative or not finite: influence 0 of vertex 0",
         [](Arrays& a) { a.partArrays[0].influenceWeights[0] = -1.0f; }},
        {"part 0: 1 influence is of no joint of the skin: joint 2 of 2 at influence 0 of vertex 0",
         [](Arrays& a) { a.partArrays[0].influenceJoints[0] = 2; }},
        {"part 0: target 0: weight is not finite", [](Arrays& a) { a.partArrays[0].targets[0].weight = kNan; }},
        {"part 0 target 0: 1 displacement is of no vertex: entry 1",
         [](Arrays& a) { a.partArrays[0].movedVertices[0][1] = 8; }},
        {"part 0 target 0: 1 vertex is there twice: entry 1",
         [](Arrays& a) { a.partArrays[0].movedVertices[0][1] = 0; }},
        {"part 0: displacements is null", [](Arrays& a) { a.parts[0].displacements = nullptr; },
         ErrorCode::nullPointer},
    });
}

TEST(ArrayFaults, OfCages) {
    static const uint32_t kMaterials[] = {0, 1, 0, 2}, kFallingRound[] = {3, 2};
    expectFaults({
        {"part 0: 1 position is not finite or beyond 1e+09: vertex 1",
         [](Arrays& a) { a.partArrays[0].positions[4] = kNan; }},
        {"part 0: 1 corner names no vertex: vertex 8 of 8 in face 1",
         [](Arrays& a) { a.partArrays[0].faceVertexIndices[5] = 8; }},
        {"part 0: 2 faces have no such material, the first is material 1 of 1 at face 1",
         [](Arrays& a) { cageOf(a).faceMaterials = kMaterials; }},
        {"part 0: 2 round corners are no vertices, or do not rise, the first is round corner 0",
         [](Arrays& a) {
             static const uint32_t kRound[] = {9, 2};
             cageOf(a).roundCornerCount = 2;
             cageOf(a).roundCorners = kRound;
         }},
        {"part 0: 1 round corner is no vertex, or does not rise: round corner 1",
         [](Arrays& a) {
             cageOf(a).roundCornerCount = 2;
             cageOf(a).roundCorners = kFallingRound;
         }},
        {"part 0: 1 of cornerNormals is not finite or beyond 1e+09: corner 2",
         [](Arrays& a) {
             static std::vector<float> normals(48, 1.0f);
             normals[7] = kNan;
             cageOf(a).cornerNormals = normals.data();
         }},
        {"part 0: 1 of faceTriangles is no corner of its face: corner 4 of face 0",
         [](Arrays& a) {
             static const uint32_t kTriangles[] = {0, 1, 2,  0, 2,  4,  4,  5,  6,  4,  6,  7,
                                                   8, 9, 10, 8, 10, 11, 12, 13, 14, 12, 14, 15};
             cageOf(a).faceTriangles = kTriangles;
         }},
        {"part 0: 1 crease has one vertex at both ends: crease 0",
         [](Arrays& a) {
             static const uint32_t kEdge[] = {1, 1};
             static const float kSharpness = 1.0f;
             cageOf(a).creaseCount = 1;
             cageOf(a).creaseVertices = kEdge;
             cageOf(a).creaseSharpnesses = &kSharpness;
         }},
        {"part 0: 1 crease set has no name: crease set 1",
         [](Arrays& a) {
             static const char* const kNames[] = {"a", nullptr};
             cageOf(a).creaseSetCount = 2;
             cageOf(a).creaseSetNames = kNames;
         }},
        {"part 0: 1 crease scalar has no such vertices, or an alpha that is not in [0, 1]: crease scalar 0",
         [](Arrays& a) {
             static const SuppleCreaseScalar kScalar{0, 1, -0.1f};
             cageOf(a).creaseScalarCount = 1;
             cageOf(a).creaseScalars = &kScalar;
         }},
    });
}

TEST(ArrayFaults, OfClips) {
    expectFaults({
        {"clip 0 channel 0: node 3 of 3", [](Arrays& a) { a.clipArrays[0].channels[0].node = 3; }},
        {"clip 0 channel 0: no such path or interpolation",
         [](Arrays& a) { a.clipArrays[0].channels[0].path = static_cast<SuppleChannelPath>(4); }, ErrorCode::range},
        {"clip 0 channel 0: 7 numbers for 2 keys of 4", [](Arrays& a) { a.clipArrays[0].channels[0].valueCount = 7; }},
        {"clip 0 channel 0: no keys", [](Arrays& a) { a.clipArrays[0].channels[0].keyCount = 0; }},
        {"clip 0 channel 0: times or values is null", [](Arrays& a) { a.clipArrays[0].channels[0].times = nullptr; },
         ErrorCode::nullPointer},
        {"clip 0 channel 0: times[1]: not later than the key before it",
         [](Arrays& a) {
             static const float kTimes[] = {1.0f, 1.0f};
             a.clipArrays[0].channels[0].times = kTimes;
         }},
        {"clip 0 channel 1: values[1]: not finite",
         [](Arrays& a) {
             static const float kValues[] = {0.0f, kNan};
             a.clipArrays[0].channels[1].values = kValues;
         }},
        {"clip 0 channel 1: a second channel for rotation of node 2",
         [](Arrays& a) { a.clipArrays[0].channels[1] = a.clipArrays[0].channels[0]; }},
        {"clip 0: duration is negative, not finite or beyond 1e+09", [](Arrays& a) { a.clips[0].duration = -1.0; }},
        {"clip 0: marker 0: time 3 is behind the clip's end, 2 s",
         [](Arrays& a) { a.clipArrays[0].markers[0].time = 3.0; }},
    });
}

TEST(ArrayFaults, OfMaterials) {
    expectFaults({
        {"material 0: no such alphaMode", [](Arrays& a) { a.materials[0].alphaMode = static_cast<SuppleAlphaMode>(3); },
         ErrorCode::range},
        {"material 0: roughnessFactor is not finite", [](Arrays& a) { a.materials[0].roughnessFactor = kNan; }},
        {"material 0: normal: image 4 or alternateImage 4294967295 of 1",
         [](Arrays& a) { a.materials[0].normal.image = 4; }},
        {"material 0: baseColor: no such wrap, magFilter, minFilter or uvSet",
         [](Arrays& a) { a.materials[0].baseColor.uvSet = 2; }, ErrorCode::range},
        {"material 0: ior is not finite", [](Arrays& a) { a.layers[0].ior = kNan; }},
        {"material 0: sheenColorTexture: image 4 or alternateImage 4294967295 of 1",
         [](Arrays& a) { a.layers[0].sheenColor.image = 4; }},
        {"material 0: trimTiles is not 1..1024", [](Arrays& a) { a.materials[0].trimDomain = SUPPLE_TRIM_FACE; },
         ErrorCode::range},
        {"material 0: trim: no image",
         [](Arrays& a) {
             a.materials[0].trimDomain = SUPPLE_TRIM_UV;
             a.materials[0].trim.image = SUPPLE_NO_IMAGE;
             a.materials[0].trim.alternateImage = SUPPLE_NO_IMAGE;
         }},
    });
}

TEST(ArrayFaults, AllAreToldAtOnce) {
    const Result<cage::Character> read = readTube([](Arrays& a) {
        a.nodes[1].parent = 9;
        a.partArrays[0].positions[4] = kNan;
        a.partArrays[0].faceVertexIndices[5] = 8;
        a.partArrays[0].influenceWeights[0] = -1.0f;
        a.partArrays[0].movedVertices[0][1] = 8;
        a.clipArrays[0].channels[0].keyCount = 0;
        a.clipArrays[0].channels[1].node = 3;
        a.materials[0].roughnessFactor = kNan;
    });
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().message, "tube: node 1: parent 9 of 3\n"
                                    "tube: material 0: roughnessFactor is not finite\n"
                                    "tube: part 0: 1 position is not finite or beyond 1e+09: vertex 1\n"
                                    "tube: part 0: 1 corner names no vertex: vertex 8 of 8 in face 1\n"
                                    "tube: part 0: 1 weight is negative or not finite: influence 0 of vertex 0\n"
                                    "tube: part 0 target 0: 1 displacement is of no vertex: entry 1\n"
                                    "tube: clip 0 channel 0: no keys\n"
                                    "tube: clip 0 channel 1: node 3 of 3");
}

TEST(ArrayFaults, TwoPartsOfOneNode) {
    const Result<cage::Character> read = readTube([](Arrays& a) {
        a.parts.push_back(a.parts[0]);
        a.desc.parts = a.parts.data();
        a.desc.partCount = 2;
    });
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().message, "tube: part 1: node 0 carries part 0");
}

/// As a file's: with a warning.
TEST(ArrayRepairs, WeightsAreNormalised) {
    const Result<cage::Character> read = readTube([](Arrays& a) {
        std::vector<float>& weights = a.partArrays[0].influenceWeights;
        weights[0] = 0.5f;
        weights[1] = 0.0f;
    });
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(CharacterDifferences(tube(), *read, {true, true, true}).found(), Strings());
    EXPECT_EQ(read->warnings,
              (Strings{"part 0 influences: normalised: they do not sum to 1 at 1 vertex, largest deviation 0.5",
                       "part 0 influences: all zero at 1 vertex; bound to the first joint named there"}));
}

TEST(ArrayRepairs, WhatHasNoFaceIsLeftOut) {
    const Spoil spoil = [](Arrays& a) { // the last face has two corners, so two vertices have a face less
        a.partArrays[0].faceVertexCounts[3] = 2;
        a.partArrays[0].faceVertexIndices.resize(14);
        cageOf(a).faceVertexIndices = a.partArrays[0].faceVertexIndices.data();
        a.partArrays[0].positions.insert(a.partArrays[0].positions.begin(), {9.0f, 9.0f, 9.0f});
        for (uint32_t& v : a.partArrays[0].faceVertexIndices) {
            ++v;
        }
        cageOf(a).positions = a.partArrays[0].positions.data();
        cageOf(a).vertexCount = 9;
        a.partArrays[0].starts.insert(a.partArrays[0].starts.begin() + 1, 1);
        for (size_t i = 2; i < a.partArrays[0].starts.size(); ++i) {
            ++a.partArrays[0].starts[i];
        }
        a.partArrays[0].influenceJoints.insert(a.partArrays[0].influenceJoints.begin(), 0);
        a.partArrays[0].influenceWeights.insert(a.partArrays[0].influenceWeights.begin(), 1.0f);
        a.parts[0].influences = {a.partArrays[0].starts.data(), 0, a.partArrays[0].influenceJoints.data(),
                                 a.partArrays[0].influenceWeights.data()};
        a.parts[0].targetCount = 0;
        a.desc.clipCount = 0;
    };
    const Result<cage::Character> read = readTube(spoil);
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->cage.faceCount(), 3u);
    EXPECT_EQ(read->cage.sourceVertices, (std::vector<uint32_t>{1, 2, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(read->cage.positions, tube().cage.positions);
    EXPECT_EQ(read->warnings, (Strings{"part 0: 1 face has fewer than three corners: face 3; left out",
                                       "part 0: 1 vertex has no face: vertex 0; left out"}));
    const Result<cage::Character> strict = readTube(spoil, {true, cage::NormalCreases::never, true});
    ASSERT_FALSE(strict.ok());
    EXPECT_EQ(strict.error().message, "tube: part 0: 1 face has fewer than three corners: face 3\n"
                                      "tube: part 0: 1 vertex has no face: vertex 0");
}

/// Adds a vertex halfway between two others, with the skin of the first.
uint32_t addMiddle(cage::Character& character, uint32_t a, uint32_t b) {
    cage::Cage& cage = character.cage;
    cage.positions.push_back(0.5f * (cage.positions[a] + cage.positions[b]));
    cage.sourceVertices.push_back(cage.vertexCount() - 1);
    std::vector<cage::Influence>& influences = character.weights.influences;
    for (uint32_t i = character.weights.starts[a]; i < character.weights.starts[a + 1]; ++i) {
        influences.push_back(cage::Influence(influences[i]));
    }
    character.weights.starts.push_back(static_cast<uint32_t>(influences.size()));
    return cage.vertexCount() - 1;
}

TEST(ArrayRepairs, TCornersBecomeCorners) {
    cage::Character character = tube();
    cage::Cage& cage = character.cage;
    // Face 1 in two: those beside it have a T-corner each. Two of its sides have another face, opposite each other.
    const std::vector<uint32_t> face(cage.faceVertices.begin() + 4, cage.faceVertices.begin() + 8);
    const auto timesIn = [&](uint32_t a, uint32_t b) {
        size_t count = 0;
        for (uint32_t f = 0; f < cage.faceCount(); ++f) {
            const auto begin = cage.faceVertices.begin() + cage.faceStarts[f];
            const auto end = cage.faceVertices.begin() + cage.faceStarts[f + 1];
            count += std::find(begin, end, a) != end && std::find(begin, end, b) != end ? 1 : 0;
        }
        return count;
    };
    const size_t k = timesIn(face[0], face[1]) == 2 ? 0 : 1;
    const uint32_t a = face[k], b = face[k + 1], c = face[k + 2], d = face[(k + 3) % 4];
    const uint32_t m = addMiddle(character, a, b), n = addMiddle(character, c, d);
    std::vector<uint32_t> vertices(cage.faceVertices);
    std::copy_n(std::vector<uint32_t>{a, m, n, d}.begin(), 4, vertices.begin() + 4);
    vertices.insert(vertices.end(), {m, b, c, n});
    cage = cage::Cage{.positions = cage.positions,
                      .faceStarts = {0, 4, 8, 12, 16, 20},
                      .faceVertices = vertices,
                      .sourceVertices = cage.sourceVertices};
    const CharacterArrays arrays(character);
    const Result<cage::Character> read = runtime::characterFromArrays(arrays.desc, "tube", {});
    ASSERT_TRUE(read.ok()) << read.error().message;
    ASSERT_EQ(read->damages.size(), 1u);
    EXPECT_EQ(read->damages[0].found.find("part 0: 2 T-corners, the first is vertex "), 0u) << read->damages[0].found;
    EXPECT_EQ(read->damages[0].repair, "made five-sided facets");
    EXPECT_EQ(read->cage.faceStarts, (std::vector<uint32_t>{0, 5, 9, 14, 18, 22}));
    EXPECT_FALSE(runtime::characterFromArrays(arrays.desc, "tube", {.strict = true}).ok());
}

/// A host of another version: structs are longer or shorter, and lie at other distances.
TEST(ArrayVersions, ElementsLieAsFarApartAsTheySay) {
    struct LongNode {
        SuppleNodeDesc node;
        uint64_t later;
    };
    std::vector<LongNode> nodes;
    const auto longer = [&](Arrays& a) {
        for (const SuppleNodeDesc& node : a.nodes) {
            nodes.push_back({node, 0});
            nodes.back().node.structSize = sizeof(LongNode);
        }
        a.desc.nodes = &nodes[0].node;
    };
    const Result<cage::Character> read = readTube(longer);
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(CharacterDifferences(tube(), *read, {true, true, true}).found(), Strings());
    nodes.clear();
    const Result<cage::Character> used = readTube([&](Arrays& a) {
        longer(a);
        nodes[1].later = 1;
    });
    ASSERT_FALSE(used.ok());
    EXPECT_EQ(used.error().code, ErrorCode::structSize);
}

} // namespace
} // namespace supple::test
