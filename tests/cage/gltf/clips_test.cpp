// Clips of other files: nodes and morph targets are matched by name; what is not matched is said.
#include "cage/clip_set.h"
#include "cage/formats/reader.h"
#include "cage/node_match.h"
#include "tests/cage/gltf/reading.h"
#include "tests/support/shared_assets.h"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>

namespace supple::cage {
namespace {

using namespace test;
using Bytes = std::vector<std::byte>;

ClipFile clipFile(const Bytes& bytes, const std::string& name = "walk.glb") {
    return {.name = name, .bytes = bytes, .baseDirectory = "", .readFile = nullptr};
}

Character readWith(const GltfBuilder& character, const std::vector<Bytes>& files) {
    GltfOptions options = kKeepTriangles;
    for (const Bytes& bytes : files) {
        options.clipFiles.push_back(clipFile(bytes));
    }
    return readWell(character.glb(), options);
}

std::string refusalWith(const Bytes& file, ErrorCode code = ErrorCode::asset) {
    return messageOf(skinnedQuad().glb(), code, {.strict = true, .clipFiles = {clipFile(file)}});
}

/// A channel of the sampler of the same number.
std::string channel(int sampler, int node, const std::string& path) {
    return R"({"sampler":)" + std::to_string(sampler) + R"(,"target":{"node":)" + std::to_string(node) +
           R"(,"path":")" + path + "\"}}";
}

/// A file without meshes: `nodes`, and one clip that turns each node of `turned` round.
GltfBuilder clipsAlone(const std::string& nodes, const std::vector<int>& turned, const std::string& name = "Walk") {
    GltfBuilder b;
    b.addFloats("SCALAR", {0, 1, 2});
    b.addFloats("VEC4", {0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1});
    b.nodes = nodes;
    b.meshes = "[]";
    std::string channels;
    for (const int node : turned) {
        channels += (channels.empty() ? "" : ",") + channel(0, node, "rotation");
    }
    b.more = R"(,"animations":[{"name":")" + name + R"(","samplers":[{"input":0,"output":1}],"channels":[)" + channels +
             "]}]";
    return b;
}

/// The skeleton of skinnedQuad(), with its nodes in another order and one more above.
constexpr const char* kTwoBones =
    R"([{"name":"tip","translation":[1,0,0]},{"name":"armature","children":[2]},{"name":"root","children":[0]}])";

std::vector<std::pair<uint32_t, ChannelPath>> moved(const Clip& clip) {
    std::vector<std::pair<uint32_t, ChannelPath>> nodes;
    for (const Channel& channel : clip.channels) {
        nodes.emplace_back(channel.node, channel.path);
    }
    return nodes;
}

Strings clipNames(const Character& character) {
    Strings names;
    for (const Clip& clip : character.clips) {
        names.push_back(clip.name);
    }
    return names;
}

using Moved = std::vector<std::pair<uint32_t, ChannelPath>>;

TEST(GltfClips, AFileOfClipsMovesTheNodesOfItsNames) {
    const Character c = readWith(skinnedQuad(), {clipsAlone(kTwoBones, {0, 2}).glb()});
    EXPECT_EQ(c.warnings, Strings()) << "everything matches";
    EXPECT_EQ(clipNames(c), (Strings{"clip_0", "Walk"}));
    EXPECT_EQ(moved(c.clips[1]), (Moved{{2, ChannelPath::rotation}, {1, ChannelPath::rotation}}));
    EXPECT_EQ(c.clips[1].duration, 2.0);
    EXPECT_EQ(c.clips[1].channels[0].values, (std::vector<float>{0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1}));
    EXPECT_EQ(c.skeleton.nodes.size(), 3u) << "the skeleton is the character's";
}

TEST(GltfClips, WhatIsNotMatchedIsOneLine) {
    std::string nodes = R"([{"name":"root"})";
    std::vector<int> turned{0};
    for (int i = 1; i <= 11; ++i) {
        nodes += i == 3 ? ",{}" : R"(,{"name":"ik_)" + std::to_string(i) + "\"}";
        turned.push_back(i);
    }
    const Character c = readWith(skinnedQuad(), {clipsAlone(nodes + "]", turned).glb()});
    EXPECT_EQ(c.warnings, Strings{"walk.glb: 1 clip; 1 of 12 nodes matched by name; not matched: ik_1, ik_2, node 3, "
                                  "ik_4, ik_5, ik_6, ik_7, ik_8 and 3 more"});
    EXPECT_EQ(moved(c.clips[1]), (Moved{{1, ChannelPath::rotation}}));
    // Nodes that no clip moves are nobody's business.
    EXPECT_EQ(readWith(skinnedQuad(), {clipsAlone(nodes + "]", {0}).glb()}).warnings, Strings());
    const Character none = readWith(skinnedQuad(), {clipsAlone(R"([{"name":"other"}])", {0}).glb()});
    EXPECT_EQ(none.warnings, Strings{"walk.glb: 1 clip; 0 of 1 node matched by name; not matched: other"});
    ASSERT_EQ(none.clips.size(), 2u) << "clips keep their numbers";
    EXPECT_TRUE(none.clips[1].channels.empty());
}

TEST(GltfClips, ClipsAloneAreNoCharacter) {
    EXPECT_EQ(messageOf(clipsAlone(kTwoBones, {0})),
              "t.glb: meshes: none, but 1 clip: it is no character, but a file of clips for one");
    GltfBuilder unused = clipsAlone(kTwoBones, {0});
    const int positions = unused.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    unused.meshes = R"([{"primitives":[{"attributes":{"POSITION":)" + std::to_string(positions) + "}}]}]";
    EXPECT_EQ(messageOf(unused),
              "t.glb: nodes: none has a mesh, but 1 clip: it is no character, but a file of clips for one");
    const GltfBuilder still = skinnedQuad();
    GltfBuilder withoutClips = still;
    withoutClips.more = R"(,"skins":[{"joints":[1,2],"inverseBindMatrices":4}])";
    EXPECT_EQ(readWith(still, {withoutClips.glb()}).warnings, Strings{"walk.glb: no clips"});
    const Bytes clips = clipsAlone(kTwoBones, {0}).glb();
    const Result<Character> obj = readCharacter(toBytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "cube.obj", "",
                                                {.clipFiles = {clipFile(clips)}});
    ASSERT_FALSE(obj.ok());
    EXPECT_EQ(obj.error().message, "cube.obj: walk.glb: an OBJ file has no nodes that clips of other files could move");
}

TEST(GltfClips, RepeatedNamesGetTheFilesName) {
    const Bytes walk = clipsAlone(kTwoBones, {0}).glb();
    GltfBuilder twice = clipsAlone(kTwoBones, {0});
    twice.more =
        replaced(twice.more, R"("animations":[{"name":"Walk",)", R"("animations":[{"samplers":[],"channels":[]},{)");
    const Character c = readWell(skinnedQuad().glb(),
                                 {.clipFiles = {clipFile(walk, "a/walk.fast.glb"), clipFile(walk, "b/walk.slow.glb"),
                                                clipFile(walk, "c/walk.slow.glb"), clipFile(twice.glb(), "two.glb")}});
    EXPECT_EQ(clipNames(c), (Strings{"clip_0", "Walk", "Walk@walk.slow", "Walk@walk.slow_2", "two_0", "two_1"}));
    const Bytes unnamed = clipsAlone(kTwoBones, {0}, "").glb();
    EXPECT_EQ(clipNames(readWith(skinnedQuad(), {unnamed, unnamed, unnamed})),
              (Strings{"clip_0", "walk", "walk@walk", "walk@walk_2"}));
}

// ---- names that repeat ----------------------------------------------------------------------------------------------

Skeleton skeletonOf(const std::vector<std::pair<std::string, uint32_t>>& nodes) {
    Skeleton skeleton;
    for (uint32_t n = 0; n < nodes.size(); ++n) {
        skeleton.nodes.emplace_back();
        skeleton.nodes.back().name = nodes[n].first;
        skeleton.nodes.back().parent = nodes[n].second;
        skeleton.parentsFirst.push_back(n);
    }
    return skeleton;
}

TEST(NodeMatch, PathsTellNamesApart) {
    const Skeleton both = skeletonOf({{"left", kNone}, {"right", kNone}, {"hand", 0}, {"hand", 1}});
    const Skeleton swapped = skeletonOf({{"right", kNone}, {"left", kNone}, {"hand", 0}, {"hand", 1}});
    NodeMatch match = matchNodes(both, swapped);
    EXPECT_EQ(match.partners, (std::vector<uint32_t>{1, 0, 3, 2}));
    EXPECT_EQ(match.repeated, Strings());
    const Skeleton onlyRight = skeletonOf({{"right", kNone}, {"hand", 0}});
    EXPECT_EQ(matchNodes(onlyRight, both).partners, (std::vector<uint32_t>{1, 3}));
    EXPECT_EQ(matchNodes(onlyRight, both).repeated, Strings());
    match = matchNodes(both, onlyRight);
    EXPECT_EQ(match.partners, (std::vector<uint32_t>{kNone, 0, kNone, 1}))
        << "the first hand has lost to the right one";
    EXPECT_EQ(match.repeated, Strings{"hand"});
}

TEST(NodeMatch, ElseTheFirstIsTaken) {
    const Skeleton twins = skeletonOf({{"arm", kNone}, {"hand", 0}, {"hand", 0}});
    NodeMatch match = matchNodes(twins, twins);
    EXPECT_EQ(match.partners, (std::vector<uint32_t>{0, 1, kNone}));
    EXPECT_EQ(match.repeated, Strings{"hand"});
    const Skeleton elsewhere = skeletonOf({{"leg", kNone}, {"hand", 0}});
    EXPECT_EQ(matchNodes(elsewhere, twins).partners, (std::vector<uint32_t>{kNone, 1}));
    EXPECT_EQ(matchNodes(skeletonOf({{"", kNone}}), skeletonOf({{"", kNone}})).partners, std::vector<uint32_t>{kNone});
}

TEST(GltfClips, RepeatedNodesAreSaid) {
    const std::string twins = R"([{"name":"root","children":[1,2]},{"name":"tip"},{"name":"tip"}])";
    GltfBuilder b = clipsAlone(twins, {0, 1, 2});
    Character c = readWith(skinnedQuad(), {b.glb()});
    EXPECT_EQ(moved(c.clips[1]), (Moved{{1, ChannelPath::rotation}, {2, ChannelPath::rotation}}));
    EXPECT_EQ(c.warnings,
              Strings{"walk.glb: 1 clip; 2 of 3 nodes matched by name; not matched: tip; names that several "
                      "nodes have: tip; bones differ in length, most of all tip: 0 instead of 1"});
}

// ---- bones ----------------------------------------------------------------------------------------------------------

TEST(GltfClips, BonesOfOtherLengthsAreSaid) {
    const auto warnings = [](const std::string& tip) {
        return readWith(skinnedQuad(), {clipsAlone(replaced(kTwoBones, "[1,0,0]", tip), {0}).glb()}).warnings;
    };
    EXPECT_EQ(warnings("[0,1.009,0]"), Strings());
    EXPECT_EQ(warnings("[1.02,0,0]"), Strings{"walk.glb: 1 clip; 1 of 1 node matched by name; bones differ in length, "
                                              "most of all tip: 1.02 instead of 1"});
    // What the clips hold a bone at is its length; bones that they stretch have none.
    GltfBuilder b = clipsAlone(replaced(kTwoBones, "[1,0,0]", "[7,0,0]"), {0});
    const auto withKeys = [&](const std::vector<float>& keys) {
        GltfBuilder held = b;
        const int output = held.addFloats("VEC3", keys);
        held.more = replaced(held.more, R"({"input":0,"output":1}])",
                             R"({"input":0,"output":1},{"input":0,"output":)" + std::to_string(output) + "}]");
        held.more = replaced(held.more, R"("channels":[)", R"("channels":[)" + channel(1, 0, "translation") + ",");
        return readWith(skinnedQuad(), {held.glb()}).warnings.size();
    };
    EXPECT_EQ(withKeys({1, 0, 0, 0, 1, 0, 0, 0, 1}), 0u);
    EXPECT_EQ(withKeys({1, 0, 0, 2, 0, 0, 3, 0, 0}), 0u);
    EXPECT_EQ(withKeys({2, 0, 0, 2, 0, 0, 2, 0, 0}), 1u);
    EXPECT_EQ(withKeys({7, 0, 0, 7, 0, 0, 7, 0, 0}), 1u);
    b.nodes = kTwoBones;
    EXPECT_EQ(withKeys({2, 0, 0, 2, 0, 0, 2, 0, 0}), 0u) << "the bones are the same: the clips move it";
}

TEST(GltfClips, NodesWithMatricesAreTakenApart) {
    GltfBuilder b = skinnedQuad();
    b.nodes = replaced(b.nodes, R"("translation":[1,0,0])", R"("matrix":[0,2,0,0,-2,0,0,0,0,0,2,0,1,0,0,1])");
    b.more = R"(,"skins":[{"joints":[1,2],"inverseBindMatrices":4}])";
    const Bytes clips = clipsAlone(kTwoBones, {0}).glb();
    Character c = readWith(b, {clips});
    EXPECT_EQ(c.warnings, Strings());
    const Node& tip = c.skeleton.nodes[2];
    EXPECT_FALSE(tip.hasMatrix);
    EXPECT_EQ(tip.translation, glm::vec3(1, 0, 0));
    EXPECT_NEAR(glm::length(tip.scale - glm::vec3(2.0f)), 0.0f, 1e-6f);
    EXPECT_NEAR(std::abs(glm::dot(tip.rotation, glm::angleAxis(glm::radians(90.0f), glm::vec3(0, 0, 1)))), 1.0f, 1e-6f);
    EXPECT_EQ(moved(c.clips[0]), (Moved{{2, ChannelPath::rotation}}));
    // A mirror is a negative scale; a shear is none.
    b.nodes = replaced(b.nodes, "[0,2,0,0,-2,0,0,0,0,0,2,0,1,0,0,1]", "[-1,0,0,0,0,1,0,0,0,0,1,0,1,0,0,1]");
    c = readWith(b, {clips});
    EXPECT_EQ(c.skeleton.nodes[2].scale, glm::vec3(-1, 1, 1));
    b.nodes = replaced(b.nodes, "[-1,0,0,0,0,1,0,0,0,0,1,0,1,0,0,1]", "[1,0,0,0,1,1,0,0,0,0,1,0,1,0,0,1]");
    c = readWith(b, {clips});
    EXPECT_TRUE(c.skeleton.nodes[2].hasMatrix);
    EXPECT_TRUE(c.clips[0].channels.empty());
    EXPECT_EQ(c.warnings, Strings{"walk.glb: 1 clip; 1 of 1 node matched by name; matrices that are no translation, "
                                  "rotation and scale: tip"});
}

// ---- weights --------------------------------------------------------------------------------------------------------

/// skinnedQuad() with a named node and targets; `names` as JSON, or empty.
GltfBuilder morphedQuad(int targets, const std::string& names, const std::string& weights = "") {
    GltfBuilder b = skinnedQuad();
    const std::string dense = std::to_string(b.addFloats("VEC3", {0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 2}));
    std::string list;
    for (int t = 0; t < targets; ++t) {
        list += (t == 0 ? "" : ",") + (R"({"POSITION":)" + dense + "}");
    }
    b.meshes = replaced(b.meshes, R"("mode":4)", R"("targets":[)" + list + "]");
    const std::string ofMesh = (names.empty() ? "" : R"("extras":{"targetNames":)" + names + "},") +
                               (weights.empty() ? "" : R"("weights":)" + weights + ",");
    b.meshes = replaced(b.meshes, R"([{"primitives")", "[{" + ofMesh + R"("primitives")");
    b.nodes = replaced(b.nodes, R"("mesh":0,"skin":0)", R"("name":"face","mesh":0,"skin":0)");
    return b;
}

/// A clip of weights for the node "face", which carries a mesh of those targets, or none.
GltfBuilder weightsAlone(const std::vector<float>& keys, int meshTargets, const std::string& names = "",
                         const std::string& interpolation = "LINEAR") {
    GltfBuilder b = meshTargets > 0 ? morphedQuad(meshTargets, names) : clipsAlone(R"([{"name":"face"}])", {});
    if (meshTargets > 0) {
        b.nodes = replaced(b.nodes, R"(,"skin":0)", "");
    }
    const int times = b.addFloats("SCALAR", {0, 1});
    const int output = b.addFloats("SCALAR", keys);
    b.more = R"(,"animations":[{"name":"Talk","samplers":[{"input":)" + std::to_string(times) + R"(,"output":)" +
             std::to_string(output) + R"(,"interpolation":")" + interpolation + R"("}],"channels":[)" +
             channel(0, 0, "weights") + "]}]";
    return b;
}

TEST(GltfClips, WeightsAreMatchedByTargetNames) {
    const GltfBuilder face = morphedQuad(3, R"(["smile","frown","blink"])", "[0.25,0.5,0.75]");
    Character c = readWith(face, {weightsAlone({1, 2, 3, 4}, 2, R"(["blink","smile"])").glb()});
    EXPECT_EQ(c.warnings, Strings());
    ASSERT_EQ(c.clips[1].channels.size(), 1u);
    EXPECT_EQ(c.clips[1].channels[0].values, (std::vector<float>{2, 0.5f, 1, 4, 0.5f, 3})) << "frown stays at rest";
    c = readWith(face, {weightsAlone({1, 2, 3, 4}, 2, R"(["blink","jaw"])").glb()});
    EXPECT_EQ(c.clips[1].channels[0].values, (std::vector<float>{0.25f, 0.5f, 1, 0.25f, 0.5f, 3}));
    EXPECT_EQ(c.warnings,
              Strings{"walk.glb: 1 clip; 1 of 1 node matched by name; morph weights not matched: face (jaw)"});
    c = readWith(face, {weightsAlone({1, 2}, 1, R"(["jaw"])").glb()});
    EXPECT_TRUE(c.clips[1].channels.empty());
    // Tangents of what stays at rest are zero; equal names are matched in their order.
    const GltfBuilder twins = morphedQuad(3, R"(["smile","smile","blink"])", "[0,0,0.75]");
    c = readWith(
        twins, {weightsAlone({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, 2, R"(["smile","smile"])", "CUBICSPLINE").glb()});
    EXPECT_EQ(c.clips[1].channels[0].values,
              (std::vector<float>{1, 2, 0, 3, 4, 0.75f, 5, 6, 0, 7, 8, 0, 9, 10, 0.75f, 11, 12, 0}));
}

TEST(GltfClips, WeightsWithoutNamesAreMatchedByCount) {
    const GltfBuilder face = morphedQuad(2, R"(["smile","frown"])");
    for (const int meshTargets : {2, 0}) { // 0: the keys alone say how many there are
        const Character c = readWith(face, {weightsAlone({1, 2, 3, 4}, meshTargets).glb()});
        EXPECT_EQ(c.warnings, Strings());
        EXPECT_EQ(c.clips[1].channels[0].values, (std::vector<float>{1, 2, 3, 4}));
    }
    const Character c = readWith(face, {weightsAlone({1, 2, 3, 4, 5, 6}, 0).glb()});
    EXPECT_TRUE(c.clips[1].channels.empty());
    EXPECT_EQ(c.warnings, Strings{"walk.glb: 1 clip; 1 of 1 node matched by name; morph weights not matched: face (3 "
                                  "for 2 targets)"});
    GltfBuilder plain = skinnedQuad();
    plain.nodes = replaced(plain.nodes, R"("mesh":0,"skin":0)", R"("name":"face","mesh":0,"skin":0)");
    EXPECT_EQ(readWith(plain, {weightsAlone({1, 2}, 0).glb()}).warnings,
              Strings{"walk.glb: 1 clip; 1 of 1 node matched by name; morph weights not matched: face (no targets)"});
    EXPECT_EQ(refusalWith(weightsAlone({1, 2, 3}, 0).glb()),
              "t.glb: walk.glb: animation 0 channel 0 output: 3 elements for 2 keys");
}

TEST(GltfClips, PartsThatAClipMovesApartShareNoTargets) {
    // Two parts with the same targets: shared, unless a clip of any file moves them differently.
    GltfBuilder b = morphedQuad(1, R"(["smile"])");
    b.nodes = replaced(b.nodes, R"([{"name":"face")", R"([{"name":"beard","mesh":0,"skin":0},{"name":"face")");
    b.nodes = replaced(b.nodes, R"("children":[2])", R"("children":[3])");
    b.more = R"(,"skins":[{"joints":[2,3],"inverseBindMatrices":4}])";
    EXPECT_EQ(readWell(b.glb(), {.sewParts = false}).morphs.targets.size(), 1u);
    const Bytes talk = weightsAlone({0, 1}, 0).glb();
    const Character c = readWell(b.glb(), {.sewParts = false, .clipFiles = {clipFile(talk)}});
    ASSERT_EQ(c.parts.size(), 2u);
    EXPECT_EQ(c.morphs.targets.size(), 2u);
    ASSERT_EQ(c.clips[0].channels.size(), 1u);
    EXPECT_EQ(c.clips[0].channels[0].firstTarget, c.parts[1].firstTarget);
    EXPECT_NE(c.parts[0].firstTarget, c.parts[1].firstTarget);
}

// ---- whole characters -----------------------------------------------------------------------------------------------

/// A GLB's JSON and its binary chunk.
std::pair<nlohmann::json, Bytes> unpack(const Bytes& glb) {
    const auto wordAt = [&](size_t place) {
        uint32_t word = 0;
        std::memcpy(&word, glb.data() + place, sizeof word);
        return size_t{word};
    };
    const auto* text = reinterpret_cast<const char*>(glb.data()) + 20;
    const size_t binary = 20 + wordAt(12);
    return {nlohmann::json::parse(text, text + wordAt(12)),
            Bytes(glb.begin() + static_cast<ptrdiff_t>(binary + 8),
                  glb.begin() + static_cast<ptrdiff_t>(binary + 8 + wordAt(binary)))};
}

/// Studios ship it so: one file with the character, another with its animations and the skeleton alone.
TEST(GltfClips, ACharacterCutInTwoIsTheSame) {
    std::vector<std::string> paths = supple::test::sharedAssets(
        {"whole/RobotExpressive.glb", "whole/studio_spider.glb", "whole/studio_goblin.glb", "whole/kaykit_Knight.glb",
         "characters/knight.glb", "characters/mh_female1605_morph.glb"});
    paths.push_back(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb");
    for (const std::string& path : paths) {
        SCOPED_TRACE(path);
        std::ifstream stream(path, std::ios::binary);
        const std::string content((std::istreambuf_iterator<char>(stream)), {});
        const Character whole = readWell(toBytes(content));
        auto [json, binary] = unpack(toBytes(content));
        nlohmann::json motion = json;
        json.erase("animations");
        for (const char* key : {"meshes", "skins", "materials", "textures", "images"}) {
            motion.erase(key);
        }
        for (nlohmann::json& node : motion["nodes"]) {
            for (const char* key : {"mesh", "skin", "weights"}) {
                node.erase(key);
            }
        }
        const Bytes clips = packGlb(motion.dump(), binary);
        const Character joined =
            readWell(packGlb(json.dump(), binary), {.pairing = Pairing::never, .clipFiles = {clipFile(clips)}});
        EXPECT_EQ(joined.warnings, whole.warnings);
        EXPECT_EQ(clipNames(joined), clipNames(whole));
        EXPECT_EQ(joined.morphs.targets.size(), whole.morphs.targets.size());
        ASSERT_EQ(joined.clips.size(), whole.clips.size());
        for (size_t i = 0; i < whole.clips.size(); ++i) {
            EXPECT_EQ(joined.clips[i].duration, whole.clips[i].duration);
            ASSERT_EQ(joined.clips[i].channels.size(), whole.clips[i].channels.size()) << whole.clips[i].name;
            for (size_t k = 0; k < whole.clips[i].channels.size(); ++k) {
                const Channel &a = joined.clips[i].channels[k], &b = whole.clips[i].channels[k];
                EXPECT_TRUE(a.node == b.node && a.path == b.path && a.interpolation == b.interpolation &&
                            a.times == b.times && a.values == b.values && a.firstTarget == b.firstTarget)
                    << whole.clips[i].name << " channel " << k;
            }
        }
    }
}

// ---- hostile files --------------------------------------------------------------------------------------------------

TEST(GltfClips, FilesThatCannotBeReadAreNamed) {
    EXPECT_EQ(refusalWith(toBytes("not a file")).substr(0, 17), "t.glb: walk.glb: ");
    EXPECT_EQ(refusalWith({}).substr(0, 17), "t.glb: walk.glb: ");
    GltfBuilder b = clipsAlone(kTwoBones, {0});
    b.setFloat(1, 0, NAN);
    EXPECT_EQ(refusalWith(b.glb()), "t.glb: walk.glb: animation 0 channel 0 output[0]: not finite");
    b = clipsAlone(kTwoBones, {0, 0});
    EXPECT_EQ(refusalWith(b.glb()), "t.glb: walk.glb: animation 0 channel 1: a second channel for rotation of node 0");
    b = clipsAlone(R"([{"name":"a","children":[1]},{"name":"b","children":[0]}])", {0});
    EXPECT_EQ(refusalWith(b.glb()).substr(0, 17), "t.glb: walk.glb: ");
    b = clipsAlone(kTwoBones, {7});
    EXPECT_EQ(refusalWith(b.glb()).substr(0, 28), "t.glb: walk.glb: animation 0");
    // External files are looked for where the clip file says, not where the character does.
    const std::string text = clipsAlone(kTwoBones, {0}).json("elsewhere.bin");
    GltfOptions options{.pairing = Pairing::never, .clipFiles = {clipFile(toBytes(text))}};
    Strings asked;
    options.readFile = [](const std::string&) -> Result<Bytes> { return Error{ErrorCode::io, "of the character"}; };
    options.clipFiles[0].readFile = [&](const std::string& path) -> Result<Bytes> {
        asked.push_back(path);
        return clipsAlone(kTwoBones, {0}).binary();
    };
    const Bytes bytes = toBytes(text);
    options.clipFiles[0].bytes = bytes;
    EXPECT_EQ(readWell(skinnedQuad().glb(), options).clips.size(), 2u);
    EXPECT_EQ(asked, Strings{"elsewhere.bin"});
}

TEST(GltfClips, ImagesAndMaterialsOfAClipFileAreNotRead) {
    GltfBuilder b = skinnedQuad();
    b.more += R"(,"images":[{"uri":"missing.png"}],"textures":[{"source":9}],"materials":[{"alphaMode":7}])";
    EXPECT_EQ(readWith(skinnedQuad(), {b.glb()}).warnings, Strings());
}

/// A few keys for many targets are many numbers: they are counted before they are made.
TEST(GltfClips, SmallFilesTakeNoLargeMemory) {
    GltfBuilder face = morphedQuad(1, "");
    constexpr int kTargets = 3000;
    std::string targets, names;
    for (int t = 0; t < kTargets; ++t) {
        targets += t == 0 ? "{}" : ",{}";
        names += (t == 0 ? "\"t" : ",\"t") + std::to_string(t) + "\"";
    }
    face.meshes =
        R"([{"extras":{"targetNames":[)" + names +
        R"(]},"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3,"targets":[)" +
        targets + "]}]}]";
    GltfBuilder clip = morphedQuad(1, R"(["t7"])");
    clip.nodes = replaced(clip.nodes, R"(,"skin":0)", "");
    std::vector<float> times(30000);
    for (size_t k = 0; k < times.size(); ++k) {
        times[k] = static_cast<float>(k);
    }
    const std::string input = std::to_string(clip.addFloats("SCALAR", times));
    clip.more = R"(,"animations":[{"samplers":[{"input":)" + input + R"(,"output":)" + input + R"(}],"channels":[)" +
                channel(0, 0, "weights") + "]}]";
    EXPECT_EQ(messageOf(face.glb(), ErrorCode::limit, {.clipFiles = {clipFile(clip.glb())}}),
              "t.glb: walk.glb: for this character, its clips hold more than 67108864 numbers");
    // Many nodes with one long list of names, and many names that repeat.
    std::string nodes;
    for (int n = 0; n < 20000; ++n) {
        nodes += (n == 0 ? "[" : ",") + std::string(R"({"name":"face","mesh":0})");
    }
    GltfBuilder many = weightsAlone({1, 2}, 0);
    many.nodes = nodes + "]";
    many.meshes = R"([{"extras":{"targetNames":[)" + names + R"(]},"primitives":[{"attributes":{"POSITION":0}}]}])";
    EXPECT_EQ(readWith(skinnedQuad(), {many.glb()}).clips.size(), 2u);
}

TEST(GltfClips, DamagedClipFilesAreRefusedOrRead) {
    Bytes whole = weightsAlone({1, 2, 3, 4}, 2, R"(["blink","smile"])").glb();
    const Bytes face = morphedQuad(2, R"(["smile","frown"])").glb();
    std::mt19937 random(11);
    size_t read = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        Bytes damaged = whole;
        if (trial % 8 == 0) {
            damaged.resize(random() % damaged.size());
        }
        for (uint32_t k = random() % 4; !damaged.empty() && k < 4; ++k) {
            damaged[random() % damaged.size()] = static_cast<std::byte>(random());
        }
        const Result<Character> result = readGltf(face, "t.glb", "", {.clipFiles = {clipFile(damaged)}});
        read += result.ok() ? 1 : 0;
        if (!result.ok()) {
            EXPECT_EQ(result.error().message.substr(0, 17), "t.glb: walk.glb: ");
        }
    }
    EXPECT_GT(read, 0u);
    EXPECT_LT(read, 4000u);
}

} // namespace
} // namespace supple::cage
