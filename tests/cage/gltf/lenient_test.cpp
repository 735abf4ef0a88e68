// One bad thing does not refuse a file: what is broken is mended or left out, as little of it as can be, with one
// warning. What a strict reading says of the same faults is in refusals_test.cpp.
#include "tests/cage/gltf/reading.h"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

namespace supple::cage {
namespace {

using namespace test;

constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

/// The quad with something replaced in its JSON, read leniently.
Character lenientQuad(const std::string& from, const std::string& to) {
    const GltfBuilder b = skinnedQuad();
    return readWell(packGlb(replaced(b.json(), from, to), b.binary()));
}
Character lenientQuadWithFloat(QuadAccessor accessor, size_t component, float value) {
    GltfBuilder b = skinnedQuad();
    b.setFloat(accessor, component, value);
    return readWell(b);
}

/// Two triangles, side by side, in two primitives; `second` follows the attributes of the second one.
GltfBuilder twoPrimitives(const std::string& first, const std::string& second) {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    b.addFloats("VEC3", {5, 0, 0, 6, 0, 0, 5, 1, 0});
    b.meshes =
        R"([{"primitives":[{"attributes":{"POSITION":0)" + first + R"(},{"attributes":{"POSITION":1)" + second + "}]}]";
    return b;
}

TEST(GltfLenient, KeysAtOneTimeMakeAJump) {
    const Character c = lenientQuadWithFloat(kTimes, 1, 0.0f);
    ASSERT_EQ(c.clips[0].channels.size(), 2u);
    const std::vector<float>& times = c.clips[0].channels[0].times;
    EXPECT_EQ(times, (std::vector<float>{0.0f, std::numeric_limits<float>::denorm_min(), 2.0f}));
    EXPECT_EQ(c.warnings,
              (Strings{"animation 0 channel 0 input[1]: not later than the key before it; moved behind it",
                       "animation 0 channel 1 input[1]: not later than the key before it; moved behind it"}));
    const Character back = lenientQuadWithFloat(kTimes, 2, 0.5f);
    EXPECT_EQ(back.clips[0].channels[1].times, (std::vector<float>{0.0f, 1.0f}));
    EXPECT_EQ(back.clips[0].channels[1].values, (std::vector<float>{0, 0, 0, 1, 2, 3}));
    EXPECT_EQ(back.warnings[0],
              "animation 0 channel 0 input[2]: not later than the key before it; the key is left out");
    EXPECT_EQ(back.clips[0].duration, 1.0);
}

TEST(GltfLenient, KeysThatAreNoNumbersAreLeftOut) {
    const Character value = lenientQuadWithFloat(kTranslations, 4, kNotANumber);
    EXPECT_EQ(value.clips[0].channels[1].times, (std::vector<float>{0.0f, 2.0f}));
    EXPECT_EQ(value.clips[0].channels[1].values, (std::vector<float>{0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(value.clips[0].channels[0].times.size(), 3u);
    EXPECT_EQ(value.warnings, (Strings{"animation 0 channel 1 output[1]: not finite; the key is left out"}));
    const Character zero = lenientQuadWithFloat(kRotations, 3, 0.0f);
    EXPECT_EQ(zero.clips[0].channels[0].times, (std::vector<float>{1.0f, 2.0f}));
    EXPECT_EQ(zero.warnings, (Strings{"animation 0 channel 0 output[0]: zero quaternion; the key is left out"}));
    const Character time = lenientQuadWithFloat(kTimes, 1, kNotANumber);
    EXPECT_EQ(time.clips[0].channels[0].times, (std::vector<float>{0.0f, 2.0f}));
    EXPECT_EQ(time.clips[0].channels[0].values, (std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1}));
}

TEST(GltfLenient, ChannelsAreLeftOutAlone) {
    const std::string first = R"({"sampler":0,"target":{"node":2,"path":"rotation"}})";
    const auto check = [&](const Character& c, const std::string& warning) {
        SCOPED_TRACE(warning);
        ASSERT_EQ(c.clips.size(), 1u);
        ASSERT_EQ(c.clips[0].channels.size(), 1u);
        EXPECT_EQ(c.clips[0].channels[0].path, ChannelPath::translation);
        EXPECT_EQ(c.warnings, Strings{warning});
    };
    check(lenientQuad(first, R"({"sampler":2,"target":{"node":2,"path":"rotation"}})"),
          "animation 0 channel 0 sampler: sampler 2 is out of range: the file has 2; left out");
    check(lenientQuad(first, R"({"sampler":0,"target":{"node":3,"path":"rotation"}})"),
          "animation 0 channel 0 target node: node 3 is out of range: the file has 3; left out");
    check(lenientQuad(R"({"input":5,"output":6})", R"({"input":5,"output":2})"),
          "animation 0 channel 0 output: 4 elements for 3 keys; left out");
    // A channel twice: the first one counts.
    const Character twice = lenientQuad(first, R"({"sampler":1,"target":{"node":2,"path":"translation"}})");
    check(twice, "animation 0 channel 1: a second channel for translation of node 2; left out");
    // A sampler without keys.
    const GltfBuilder b = skinnedQuad();
    const Character none =
        readWell(packGlb(replaced(b.json(), R"({"bufferView":6,"componentType":5126,"count":3,"type":"VEC4"})",
                                  R"({"bufferView":6,"componentType":5126,"count":0,"type":"VEC4"})"),
                         b.binary()));
    EXPECT_EQ(none.clips[0].channels.size(), 1u);
    EXPECT_EQ(none.warnings, (Strings{"accessor 6 count: zero; left out",
                                      "animation 0 channel 0 output: accessor 6 cannot be read; left out"}));
}

TEST(GltfLenient, AMatrixThatIsAnimatedIsTakenApart) {
    const Character c = lenientQuad(R"({"name":"tip","translation":[1,0,0]})",
                                    R"({"name":"tip","matrix":[0,2,0,0,-2,0,0,0,0,0,2,0,1,0,0,1]})");
    EXPECT_EQ(c.clips[0].channels.size(), 2u);
    EXPECT_FALSE(c.skeleton.nodes[2].hasMatrix);
    EXPECT_EQ(c.skeleton.nodes[2].scale, glm::vec3(2.0f));
    EXPECT_EQ(c.skeleton.nodes[2].translation, glm::vec3(1, 0, 0));
    EXPECT_EQ(c.warnings,
              (Strings{"animation 0 channel 0: animates node 2, which has a matrix; the matrix is taken apart"}));
    const Character sheared = lenientQuad(R"({"name":"tip","translation":[1,0,0]})",
                                          R"({"name":"tip","matrix":[1,0,0,0,1,1,0,0,0,0,1,0,1,0,0,1]})");
    EXPECT_TRUE(sheared.clips[0].channels.empty()) << "a shear is none of translation, rotation and scale";
}

TEST(GltfLenient, PrimitivesAreLeftOutAlone) {
    const auto expectOne = [&](const GltfBuilder& b, const std::string& warning) {
        SCOPED_TRACE(warning);
        const Character c = readWell(b);
        EXPECT_EQ(c.cage.faceCount(), 1u);
        EXPECT_EQ(c.cage.positions.at(0), glm::vec3(0.0f));
        EXPECT_EQ(c.warnings.empty() ? "" : c.warnings.back(), warning);
    };
    GltfBuilder nan = twoPrimitives("}", "}");
    nan.setFloat(static_cast<QuadAccessor>(1), 4, kNotANumber);
    expectOne(nan, "mesh 0 primitive 1 POSITION[1]: not finite; left out");
    expectOne(twoPrimitives("}", R"(},"indices":9)"),
              "mesh 0 primitive 1 indices: accessor 9 is out of range: the file has 2; left out");
    expectOne(twoPrimitives("}", R"(},"mode":9)"), "mesh 0 primitive 1 mode: not in 0..6; left out");
    GltfBuilder far = twoPrimitives("}", R"(},"indices":2)");
    far.addIntegers("SCALAR", 5123, {0, 1, 3});
    expectOne(far, "mesh 0 primitive 1 indices[2]: 3 is out of range: the primitive has 3 vertices; left out");
    // The last one of a file is not left out: then the file is refused, and says all.
    GltfBuilder both = twoPrimitives(R"(},"mode":9)", "}");
    both.setFloat(static_cast<QuadAccessor>(1), 4, kNotANumber);
    EXPECT_EQ(saidOf(both.glb()), "refused: t.glb: mesh 0 primitive 0 mode: not in 0..6\n"
                                  "t.glb: mesh 0 primitive 1 POSITION[1]: not finite");
}

TEST(GltfLenient, WhatIsOverIsLeftOut) {
    const Character five = lenientQuad(R"("count":6,"type":"SCALAR")", R"("count":5,"type":"SCALAR")");
    EXPECT_EQ(five.cage.faceCount(), 1u);
    EXPECT_EQ(five.warnings.back(), "mesh 0 primitive 0 indices: 5, not a multiple of 3; what is over is left out");
    EXPECT_EQ(messageOf(packGlb(
                  replaced(skinnedQuad().json(), R"("count":6,"type":"SCALAR")", R"("count":5,"type":"SCALAR")"),
                  skinnedQuad().binary())),
              "t.glb: mesh 0 primitive 0 indices: 5, not a multiple of 3");
}

/// glTF allows a primitive without positions, and no reading refuses it.
TEST(GltfLenient, APrimitiveWithoutPositionsIsNotDrawn) {
    GltfBuilder b = twoPrimitives("}", "}");
    b.meshes = replaced(b.meshes, R"({"POSITION":1})", R"({"_HEAT":1})");
    EXPECT_EQ(messageOf(b), "accepted");
    EXPECT_EQ(saidOf(b.glb()), "mesh 0 primitive 1: no POSITION; left out");
}

TEST(GltfLenient, AMeshWithoutPrimitivesIsLeftOut) {
    GltfBuilder b = twoPrimitives("}", "}");
    b.meshes.insert(b.meshes.size() - 1, R"(,{"primitives":[]})");
    b.nodes = R"([{"mesh":0},{"mesh":1}])";
    EXPECT_EQ(saidOf(b.glb()), "mesh 1: no primitives; left out");
    EXPECT_EQ(readWell(b).parts.size(), 1u);
    b.nodes = R"([{"mesh":0},{"mesh":7}])";
    EXPECT_EQ(readWell(b).parts.size(), 1u);
}

TEST(GltfLenient, TargetsThatAPrimitiveLacksDoNotMoveIt) {
    GltfBuilder b = twoPrimitives(R"(},"targets":[{"POSITION":0},{"POSITION":1}])", R"(},"targets":[{"POSITION":0}])");
    const Character c = readWell(b);
    ASSERT_EQ(c.morphs.targets.size(), 2u);
    EXPECT_EQ(c.morphs.targets[0].vertices, (std::vector<uint32_t>{1, 2, 4, 5}));
    EXPECT_EQ(c.morphs.targets[1].vertices, (std::vector<uint32_t>{0, 1, 2}));
    EXPECT_EQ(c.warnings,
              (Strings{"mesh 0 primitive 1: 1 morph target, but primitives before it have 2; it is moved by "
                       "its own alone"}));
    // The first one may have none.
    b = twoPrimitives("}", R"(},"targets":[{"POSITION":0}])");
    EXPECT_EQ(readWell(b).morphs.targets.size(), 1u);
    EXPECT_EQ(readWell(b).morphs.targets[0].vertices, (std::vector<uint32_t>{4, 5}));
}

/// A part of a skinned mesh that has no joints moves with the node that carries it.
TEST(GltfLenient, PrimitivesWithoutJointsFollowTheirNode) {
    const std::string set = R"("JOINTS_0":1,"WEIGHTS_0":2,)";
    for (const std::string& left : {std::string(), std::string(R"("WEIGHTS_0":2,)"), std::string(R"("JOINTS_0":1,)")}) {
        SCOPED_TRACE(left);
        const Character c = lenientQuad(set, left);
        ASSERT_EQ(c.skin.joints, (std::vector<uint32_t>{1, 2, 0}));
        EXPECT_TRUE(std::all_of(c.weights.influences.begin(), c.weights.influences.end(),
                                [](const Influence& i) { return i.joint == 2 && i.weight == 1.0f; }));
        EXPECT_EQ(c.warnings.size(), 1u);
        EXPECT_TRUE(c.warnings[0].ends_with("; it is not skinned, and moves with its node")) << c.warnings[0];
    }
}

TEST(GltfLenient, SkinsThatCannotBeReadAreLeftOut) {
    const std::string joints = R"({"joints":[1,2],"inverseBindMatrices":4})";
    for (const char* skin :
         {R"({"joints":[]})", R"({"joints":[1,9]})", R"({"joints":[1,2],"inverseBindMatrices":0})"}) {
        SCOPED_TRACE(skin);
        const Character c = lenientQuad(joints, skin);
        EXPECT_EQ(c.skin.joints, (std::vector<uint32_t>{0}));
        EXPECT_EQ(c.warnings.size(), 1u);
    }
}

TEST(GltfLenient, JointsWithoutMatricesAreBoundWhereTheyRest) {
    GltfBuilder b = skinnedQuad();
    b.nodes =
        R"([{"mesh":0,"skin":0},{"name":"root","children":[2]},{"name":"tip","translation":[1,0,0],"children":[3]},)"
        R"({"translation":[0,4,0]}])";
    b.more = replaced(b.more, R"("joints":[1,2])", R"("joints":[1,2,3])");
    const Character c = readWell(b);
    ASSERT_EQ(c.skin.inverseBinds.size(), 3u);
    EXPECT_EQ(c.skin.inverseBinds[2][3], glm::vec4(-1, -4, 0, 1)) << "the first two are bound where they rest, too";
    EXPECT_EQ(c.warnings,
              (Strings{"skin 0 inverseBindMatrices: 2 matrices for 3 joints; the others are bound where they rest"}));
}

TEST(GltfLenient, InfluencesAreLeftOutAlone) {
    const Character negative = lenientQuadWithFloat(kWeights, 4, -0.5f);
    EXPECT_EQ(negative.weights.starts[2] - negative.weights.starts[1], 1u);
    EXPECT_EQ(negative.weights.influences[negative.weights.starts[1]].weight, 1.0f);
    EXPECT_EQ(negative.warnings.back(), "mesh 0 primitive 0 WEIGHTS_0[1]: negative; the influence is left out");
    GltfBuilder b = skinnedQuad();
    b.setByte(kJoints, 5, 2);
    EXPECT_EQ(readWell(b).warnings.back(),
              "mesh 0 primitive 0 JOINTS_0[1]: joint 2 is out of range: the skin has 2; the "
              "influence is left out");
}

TEST(GltfLenient, MatricesAndRotationsAreMended) {
    const Character last = lenientQuadWithFloat(kInverseBinds, 15, 2.0f);
    EXPECT_EQ(last.skin.inverseBinds[0], glm::mat4(1.0f));
    EXPECT_EQ(last.warnings, (Strings{"skin 0 inverseBindMatrices[0]: last row is not 0 0 0 1; read as if it were"}));
    const Character zero = lenientQuad(R"({"name":"tip","translation":[1,0,0]})",
                                       R"({"name":"tip","translation":[1,0,0],"rotation":[0,0,0,0]})");
    EXPECT_EQ(zero.skeleton.nodes[2].rotation, glm::quat(1, 0, 0, 0));
    EXPECT_EQ(zero.warnings, (Strings{"node 2 rotation: zero quaternion; left out"}));
}

TEST(GltfLenient, NamesOfWhatIsNotThere) {
    EXPECT_EQ(lenientQuad(R"("scene":0)", R"("scene":7)").warnings,
              (Strings{"JSON scene: scene 7 is out of range: the file has 1; left out"}));
    EXPECT_EQ(lenientQuad(R"({"nodes":[0,1]})", R"({"nodes":[0,9,1]})").parts.size(), 1u);
    EXPECT_EQ(lenientQuad(R"("mode":4)", R"("material":3)").warnings,
              (Strings{"mesh 0 primitive 0 material: material 3 is out of range: the file has 0; left out"}));
    EXPECT_TRUE(lenientQuad(R"("TEXCOORD_0":8)", R"("TEXCOORD_0":99)").cage.cornerUvs.empty());
    EXPECT_TRUE(lenientQuad(R"("TEXCOORD_0":8)", R"("TEXCOORD_0":5)").cage.cornerUvs.empty());
    EXPECT_EQ(
        lenientQuad(R"({"name":"root","children":[2]})", R"({"name":"root","children":[2,2,8]})").skeleton.nodes.size(),
        3u);
}

TEST(GltfLenient, BuffersThatEndEarly) {
    const GltfBuilder b = skinnedQuad();
    const std::string length = std::to_string(b.binary().size());
    const std::string more = std::to_string(b.binary().size() + 2);
    const Character c = lenientQuad(R"({"byteLength":)" + length, R"({"byteLength":)" + more);
    EXPECT_EQ(c.warnings, (Strings{"buffer 0: truncated: byteLength is " + more + ", " + length +
                                   " bytes present; it ends there"}));
    const std::string last = R"("byteLength":32})";
    const Character view = lenientQuad(last, R"("byteLength":34})");
    EXPECT_EQ(view.warnings.size(), 1u);
    EXPECT_EQ(view.cage.cornerUvs.size(), 6u);
}

TEST(GltfLenient, SparseIndicesInAnyOrder) {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    b.addIntegers("SCALAR", 5123, {2, 1});
    b.addFloats("VEC3", {0, 7, 0, 8, 0, 0});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0}}]}])";
    const std::string json =
        replaced(b.json(), R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})",
                 R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":2,)"
                 R"("indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":2}}})");
    const Character c = readWell(packGlb(json, b.binary()));
    EXPECT_EQ(c.cage.positions, (std::vector<glm::vec3>{{0, 0, 0}, {8, 0, 0}, {0, 7, 0}}));
    EXPECT_EQ(c.warnings,
              (Strings{"mesh 0 primitive 0 POSITION sparse indices: not strictly increasing; the last value counts"}));
}

TEST(GltfLenient, ComponentsThatLackTheirFlag) {
    GltfBuilder floats = skinnedQuad();
    const int numbers = floats.addFloats("VEC4", {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    floats.meshes = replaced(floats.meshes, R"("JOINTS_0":1)", R"("JOINTS_0":)" + std::to_string(numbers));
    EXPECT_EQ(messageOf(floats), "t.glb: mesh 0 primitive 0 JOINTS_0: FLOAT components are not allowed here");
    EXPECT_EQ(saidOf(floats.glb()),
              "mesh 0 primitive 0 JOINTS_0: FLOAT components are not allowed here; read as whole numbers");
    EXPECT_EQ(readWell(floats).weights.influences[2].joint, 1u);
    EXPECT_EQ(
        saidOf(packGlb(replaced(skinnedQuad().json(), R"("JOINTS_0":1)", R"("JOINTS_0":2)"), skinnedQuad().binary())),
        "refused: t.glb: mesh 0 primitive 0 JOINTS_0[1]: not the number of a joint");
    GltfBuilder b = skinnedQuad();
    const int bytes = b.addIntegers("VEC4", 5121, {255, 0, 0, 0, 128, 127, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0});
    b.meshes = replaced(b.meshes, R"("WEIGHTS_0":2)", R"("WEIGHTS_0":)" + std::to_string(bytes));
    EXPECT_EQ(messageOf(b),
              "t.glb: mesh 0 primitive 0 WEIGHTS_0: UNSIGNED_BYTE components without \"normalized\": true");
    const Character c = readWell(b);
    EXPECT_EQ(c.weights.influences[1].weight, 128.0f / 255.0f);
    EXPECT_EQ(c.warnings.size(), 1u);

    GltfBuilder quantized = skinnedQuad();
    const int shorts = quantized.addIntegers("VEC3", 5123, {0, 0, 0, 100, 0, 0, 100, 100, 0, 0, 100, 0});
    quantized.meshes = replaced(quantized.meshes, R"("POSITION":0)", R"("POSITION":)" + std::to_string(shorts));
    EXPECT_EQ(messageOf(quantized), "t.glb: mesh 0 primitive 0 POSITION: UNSIGNED_SHORT components need "
                                    "KHR_mesh_quantization, which the file does not declare");
    EXPECT_EQ(readWell(quantized).cage.positions[2], glm::vec3(100, 100, 0));
}

TEST(GltfLenient, ChunksWithoutPadding) {
    const GltfBuilder b = skinnedQuad();
    std::string json = b.json();
    while (json.size() % 4 != 1) {
        json += ' ';
    }
    const auto put = [](std::vector<std::byte>& bytes, uint32_t value) {
        for (int i = 0; i < 4; ++i) {
            bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
        }
    };
    for (const bool padded : {true, false}) {
        std::vector<std::byte> glb;
        put(glb, 0x46546C67u);
        put(glb, 2);
        put(glb, 0);
        put(glb, static_cast<uint32_t>(json.size()));
        put(glb, 0x4E4F534Au);
        for (const char c : json) {
            glb.push_back(static_cast<std::byte>(c));
        }
        for (int i = 0; i < 3 && padded; ++i) {
            glb.push_back(std::byte{' '});
        }
        put(glb, static_cast<uint32_t>(b.binary().size()));
        put(glb, 0x004E4942u);
        glb.insert(glb.end(), b.binary().begin(), b.binary().end());
        for (int i = 0; i < 4; ++i) {
            glb[8 + static_cast<size_t>(i)] = static_cast<std::byte>(glb.size() >> (8 * i));
        }
        const std::string fault =
            padded ? "its length is no multiple of 4" : "not padded: the next chunk does not begin on a multiple of 4";
        EXPECT_EQ(saidOf(glb), "GLB chunk 0: " + fault + "; the next chunk is read where it begins");
        EXPECT_EQ(messageOf(glb), "t.glb: GLB chunk 0: " + fault);
    }
}

TEST(GltfLenient, DataUrisInCapitals) {
    std::string json = skinnedQuad().json("data:application/octet-stream;base64,");
    const std::string embedded(reinterpret_cast<const char*>(skinnedQuad().embedded().data()),
                               skinnedQuad().embedded().size());
    const std::string capitals = replaced(embedded, "data:application/octet-stream;base64,", "DATA:X;BASE64,");
    EXPECT_EQ(messageOf(toBytes(capitals)), "accepted");
}

TEST(GltfLenient, FilesOfNothingButFaultsAreRefused) {
    const GltfBuilder b = skinnedQuad();
    std::string nodes = R"({"nodes":[0,1)";
    for (int i = 0; i < 5000; ++i) {
        nodes += "," + std::to_string(100 + i);
    }
    const std::string said = saidOf(packGlb(replaced(b.json(), R"({"nodes":[0,1]})", nodes + "]}"), b.binary()));
    EXPECT_TRUE(said.starts_with("refused: t.glb: scene 0 nodes[2]: node 100 is out of range")) << said.substr(0, 200);
    EXPECT_TRUE(said.ends_with("file: more than 4096 faults")) << said.substr(said.size() - 200);
}

} // namespace
} // namespace supple::cage
