// Inputs that break loaders, one file of our own each: it reads right or is refused by name. Every case prints a row of
// what came of it.
#include "cage/topology.h"
#include "tests/cage/gltf/reading.h"

#include <cctype>
#include <cmath>
#include <cstdio>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

namespace supple::cage {
namespace {

using namespace test;

using Bytes = std::vector<std::byte>;

struct Nasty {
    const char* item;
    std::function<Bytes()> file;
    std::string refusal;                              ///< the message without the file's name; empty: it is read
    std::function<void(const Character&)> check = {}; ///< what is in the file
};

Nasty loaded(const char* item, std::function<Bytes()> file, std::function<void(const Character&)> check) {
    return {item, std::move(file), "", std::move(check)};
}

Nasty refused(const char* item, std::function<Bytes()> file, const char* refusal) {
    return {item, std::move(file), refusal, {}};
}

/// skinnedQuad() with its JSON changed in one place.
Bytes quadReplacing(const std::string& from, const std::string& to) {
    const GltfBuilder b = skinnedQuad();
    return packGlb(replaced(b.json(), from, to), b.binary());
}

Bytes quadWithFloat(QuadAccessor accessor, size_t component, float value) {
    GltfBuilder b = skinnedQuad();
    b.setFloat(accessor, component, value);
    return b.glb();
}

/// A GLB whose BIN chunk has 0 bytes.
Bytes withEmptyBinChunk(const std::string& json) {
    Bytes bytes = packGlb(json, {});
    appendU32(bytes, 0);
    appendU32(bytes, 0x004E4942u);
    for (size_t i = 0; i < 4; ++i) {
        bytes[8 + i] = static_cast<std::byte>((bytes.size() >> (8 * i)) & 0xFF);
    }
    return bytes;
}

const std::vector<float> kOnes = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

/// skinnedQuad() with an animation of its own on the tip: its interpolation, keys and rotations.
Bytes quadWithRotations(const std::string& interpolation, const std::vector<float>& times,
                        const std::vector<float>& rotations) {
    GltfBuilder b = skinnedQuad();
    const std::string input = std::to_string(b.addFloats("SCALAR", times));
    const std::string output = std::to_string(b.addFloats("VEC4", rotations));
    b.more = R"(,"skins":[{"joints":[1,2],"inverseBindMatrices":4}],"animations":[{"samplers":[{"input":)" + input +
             R"(,"output":)" + output + R"(,"interpolation":")" + interpolation +
             R"("}],"channels":[{"sampler":0,"target":{"node":2,"path":"rotation"}}]}])";
    return b.glb();
}

std::string topologyFault(const Character& c) {
    const Result<Topology> topology = buildTopology(c.cage);
    return topology.ok() ? "" : topology.error().message;
}

/// A polygon of `sides` corners, as the fan FB_ngon_encoding makes of it, and one vertex in the middle for `valence`
/// triangles round it.
GltfBuilder wheel(uint32_t sides, bool spokes) {
    std::vector<float> positions;
    std::vector<uint32_t> indices;
    for (uint32_t i = 0; i < sides; ++i) {
        const double angle = 6.283185307179586 * i / sides;
        positions.insert(positions.end(),
                         {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0});
        if (spokes) {
            indices.insert(indices.end(), {sides, i, (i + 1) % sides});
        } else if (i >= 2) {
            indices.insert(indices.end(), {0, i - 1, i});
        }
    }
    if (spokes) {
        positions.insert(positions.end(), {0, 0, 0});
    }
    return plainMesh(positions, indices, spokes ? "" : R"(,"extensions":{"FB_ngon_encoding":{}})");
}

const glm::vec3 kTetrahedron[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

std::vector<Nasty> nastyList() {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    return {
        loaded(
            "non-indexed skinned mesh",
            [] {
                return skinnedTriangle(2, {{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}},
                                       {{1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}})
                    .glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.cage.faceVertices, (std::vector<uint32_t>{0, 1, 2}));
                EXPECT_EQ(c.weights.starts, (std::vector<uint32_t>{0, 1, 2, 4}));
            }),
        loaded(
            "two primitives sharing a cage boundary",
            [] {
                GltfBuilder b;
                b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
                b.addFloats("VEC3", {1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0});
                b.addIntegers("SCALAR", 5121, {0, 1, 2, 0, 2, 3});
                b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":2,"material":1},)"
                           R"({"attributes":{"POSITION":1},"indices":2,"material":0}]}])";
                b.more = R"(,"materials":[{},{}])";
                return b.glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.cage.vertexCount(), 6u);
                EXPECT_EQ(c.cage.faceMaterials, (std::vector<uint32_t>{1, 1, 0, 0}));
                EXPECT_EQ(topologyFault(c), "");
            }),
        loaded(
            "seam vertices with different skin weights",
            [] {
                GltfBuilder b;
                b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0});
                b.addIntegers("VEC4", 5121, std::vector<uint32_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, //
                                                                  0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
                b.addFloats("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0});
                b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}])";
                b.nodes = R"([{"mesh":0,"skin":0},{},{}])";
                b.more = R"(,"skins":[{"joints":[1,2]}])";
                return b.glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.cage.vertexCount(), 4u) << "no crack: the first vertex's joint moves both";
                EXPECT_EQ(c.weights.influences[2].joint, 0u);
                EXPECT_EQ(
                    c.warnings,
                    (Strings{"mesh 0: 1 vertex agrees with another in position but not in skin (first: vertices 2 "
                             "and 4) along a seam; joined, as the first vertex of each has it"}));
            }),
        loaded(
            "joint outside the scene", [] { return quadReplacing(R"("nodes":[0,1])", R"("nodes":[0])"); },
            [](const Character& c) {
                EXPECT_EQ(c.skin.joints, (std::vector<uint32_t>{1, 2}));
                EXPECT_EQ(c.skeleton.nodes[2].translation, glm::vec3(1, 0, 0));
                EXPECT_EQ(c.skeleton.nodes[2].parent, 1u);
            }),
        loaded(
            "inverse bind matrices absent", [] { return quadReplacing(R"(,"inverseBindMatrices":4)", ""); },
            [](const Character& c) {
                EXPECT_EQ(c.skin.inverseBinds, (std::vector<glm::mat4>{glm::mat4(1.0f), glm::mat4(1.0f)}));
                EXPECT_EQ(c.warnings, Strings());
            }),
        loaded(
            "skin shared by two meshes",
            [] {
                GltfBuilder b = skinnedQuad();
                const std::string primitive =
                    R"({"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3}]})";
                b.meshes = "[" + primitive + "," + primitive + "]";
                b.nodes = R"([{"mesh":1,"skin":0},{"children":[2,3]},{},{"mesh":0,"skin":0}])";
                return b.glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.parts.size(), 2u);
                EXPECT_EQ(c.skin.joints.size(), 2u);
                EXPECT_EQ(c.warnings, Strings());
            }),
        loaded(
            "skinned mesh node with a transform of its own",
            [] { return quadReplacing(R"({"mesh":0,"skin":0})", R"({"mesh":0,"skin":0,"scale":[2,3,4]})"); },
            [](const Character& c) {
                EXPECT_EQ(c.skin.joints, (std::vector<uint32_t>{1, 2})) << "no joint, so no part in the palette";
                EXPECT_EQ(c.cage.positions[2], glm::vec3(1, 1, 0));
            }),
        loaded(
            "negative joint scale",
            [] { return quadReplacing(R"("translation":[1,0,0])", R"("translation":[1,0,0],"scale":[-1,1,-2])"); },
            [](const Character& c) { EXPECT_EQ(c.skeleton.nodes[2].scale, glm::vec3(-1, 1, -2)); }),
        loaded(
            "more than 256 joints",
            [] {
                return skinnedTriangle(300, {{256, 0, 0, 0, 299, 0, 0, 0, 7, 0, 0, 0}}, {kOnes}).glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.skin.joints.size(), 300u);
                EXPECT_EQ(c.weights.influences[0].joint, 256u);
                EXPECT_EQ(c.weights.influences[1].joint, 299u);
            }),
        loaded(
            "JOINTS_1 to JOINTS_3",
            [] {
                std::vector<std::vector<uint32_t>> joints;
                for (uint32_t n = 0; n < 4; ++n) {
                    joints.push_back({4 * n, 4 * n + 1, 4 * n + 2, 4 * n + 3, 0, 0, 0, 0, 0, 0, 0, 0});
                }
                std::vector<std::vector<float>> weights(4,
                                                        {0.0625f, 0.0625f, 0.0625f, 0.0625f, 0, 0, 0, 0, 0, 0, 0, 0});
                weights[3][4] = 1;
                weights[1][8] = 1;
                return skinnedTriangle(16, joints, weights).glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.warnings, Strings());
                EXPECT_EQ(c.weights.starts, (std::vector<uint32_t>{0, 16, 17, 18}));
                EXPECT_EQ(c.weights.influences[15].joint, 15u);
            }),
        loaded(
            "weights that sum to 0",
            [] {
                return skinnedTriangle(2, {{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}}, {std::vector<float>(12)}).glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.weights.influences[0].joint, 1u);
                EXPECT_EQ(c.weights.influences[0].weight, 1.0f);
                EXPECT_EQ(c.warnings.size(), 1u);
            }),
        loaded(
            "8-bit weights that do not sum to 255",
            [] {
                GltfBuilder b = skinnedTriangle(2, {{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}}, {kOnes});
                const int weights = b.addIntegers("VEC4", 5121, {127, 127, 0, 0, 100, 0, 0, 0, 128, 128, 0, 0}, true);
                b.meshes = replaced(b.meshes, R"("WEIGHTS_0":2)", R"("WEIGHTS_0":)" + std::to_string(weights));
                return b.glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.weights.influences[0].weight, 0.5f);
                EXPECT_EQ(c.weights.influences[2].weight, 1.0f);
                EXPECT_EQ(c.weights.influences[3].weight, 0.5f);
                EXPECT_EQ(c.warnings, (Strings{"mesh 0 WEIGHTS: normalised: they do not sum to 1 at 1 vertex, largest "
                                               "deviation 0.608"}))
                    << "254 and 256 of 255 are rounding";
            }),
        loaded(
            "sparse morph target without a bufferView",
            [] {
                GltfBuilder b = skinnedQuad();
                const int target = b.addFloats("VEC3", std::vector<float>(12, 9));
                const int indices = b.addIntegers("SCALAR", 5121, {2});
                const int values = b.addFloats("VEC3", {0, 0, 5});
                b.meshes =
                    replaced(b.meshes, R"("mode":4)", R"("targets":[{"POSITION":)" + std::to_string(target) + "}]");
                const std::string dense =
                    R"({"bufferView":)" + std::to_string(target) + R"(,"componentType":5126,"count":4)";
                return packGlb(replaced(b.json(), dense,
                                        R"({"componentType":5126,"count":4,"sparse":{"count":1,"indices":)"
                                        R"({"bufferView":)" +
                                            std::to_string(indices) + R"(,"componentType":5121},"values":)" +
                                            R"({"bufferView":)" + std::to_string(values) + "}}"),
                               b.binary());
            },
            [](const Character& c) {
                ASSERT_EQ(c.morphs.targets.size(), 1u);
                EXPECT_EQ(c.morphs.targets[0].vertices, std::vector<uint32_t>{2});
                EXPECT_EQ(c.morphs.targets[0].deltas[0], glm::vec3(0, 0, 5));
            }),
        loaded(
            "node.weights override",
            [] {
                GltfBuilder b = skinnedQuad();
                b.meshes = replaced(b.meshes, R"("mode":4}])", R"("targets":[{"POSITION":0}]}],"weights":[0.25])");
                b.nodes = replaced(b.nodes, R"("mesh":0)", R"("mesh":0,"weights":[0.75])");
                return b.glb();
            },
            [](const Character& c) { EXPECT_EQ(c.morphs.weights, std::vector<float>{0.75f}); }),
        refused(
            "CUBICSPLINE with one key",
            [] {
                return quadWithRotations("CUBICSPLINE", {0}, {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0});
            },
            "animation 0 channel 0 input: CUBICSPLINE needs at least two keys"),
        loaded(
            "keys that start later than 0",
            [] {
                return quadWithRotations("LINEAR", {1.5f, 2}, {0, 0, 0, 1, 0, 0, 1, 0});
            },
            [](const Character& c) {
                EXPECT_EQ(c.clips[0].channels[0].times, (std::vector<float>{1.5f, 2}));
                EXPECT_EQ(c.clips[0].duration, 2.0) << "the clip starts at 0 all the same";
            }),
        refused(
            "keys that do not rise",
            [] {
                return quadWithRotations("LINEAR", {0, 1, 1}, {0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1});
            },
            "animation 0 channel 0 input[2]: not later than the key before it"),
        loaded(
            "rotation by 180 degrees",
            [] {
                return quadWithRotations("LINEAR", {0, 1}, {0, 0, 0, 1, 0, 1, 0, 0});
            },
            [](const Character& c) {
                EXPECT_EQ(c.clips[0].channels[0].values, (std::vector<float>{0, 0, 0, 1, 0, 1, 0, 0}));
            }),
        loaded(
            "duplicate faces",
            [] {
                return plainMesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2, 1, 2, 0}).glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.cage.faceCount(), 1u);
                EXPECT_EQ(c.warnings, (Strings{"mesh 0: 1 face is there twice: face 1 is face 0 again; left out"}));
            }),
        loaded(
            "bow-tie vertex",
            [] {
                return plainMesh({0, 0, 0, 1, 0, 0, 1, 1, 0, -1, 0, 0, -1, -1, 0}, {0, 1, 2, 0, 3, 4}).glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.cage.vertexCount(), 6u);
                EXPECT_EQ(c.warnings, (Strings{"mesh 0: 1 vertex has faces that are no single fan: vertex 0 of 2 fans; "
                                               "one vertex for each fan"}));
            }),
        loaded(
            "valence 3", [] { return wheel(3, true).glb(); },
            [](const Character& c) {
                const Result<Topology> topology = buildTopology(c.cage);
                ASSERT_TRUE(topology.ok());
                EXPECT_EQ(topology->effectiveValence(3), 3u);
            }),
        loaded(
            "valence more than 16", [] { return wheel(40, true).glb(); },
            [](const Character& c) {
                const Result<Topology> topology = buildTopology(c.cage);
                ASSERT_TRUE(topology.ok());
                EXPECT_EQ(topology->effectiveValence(40), 40u);
            }),
        loaded(
            "open boundary", [] { return skinnedQuad().glb(); },
            [](const Character& c) {
                const Result<Topology> topology = buildTopology(c.cage);
                ASSERT_TRUE(topology.ok());
                EXPECT_EQ(topology->boundary, std::vector<uint8_t>(4, 1));
            }),
        loaded(
            "isolated vertex",
            [] {
                return plainMesh({0, 0, 0, 9, 9, 9, 1, 0, 0, 0, 1, 0}, {0, 2, 3}).glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.cage.sourceVertices, (std::vector<uint32_t>{0, 2, 3}));
                EXPECT_EQ(topologyFault(c), "");
                EXPECT_EQ(c.warnings, (Strings{"mesh 0: 1 vertex has no face; left out"}));
            }),
        loaded(
            "n-gon of more than 5 sides", [] { return wheel(9, false).glb(); },
            [](const Character& c) {
                ASSERT_EQ(c.cage.faceCount(), 1u);
                EXPECT_EQ(c.cage.sides(0), 9u);
            }),
        loaded(
            "zero-area face",
            [] {
                return plainMesh({0, 0, 0, 1, 0, 0, 2, 0, 0, 1, 1, 0}, {0, 1, 3, 1, 2, 3, 2, 1, 0}).glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.cage.faceCount(), 3u) << "a matter of positions, not of the polygons";
                EXPECT_EQ(topologyFault(c), "");
            }),
        loaded(
            "face with a repeated vertex",
            [] {
                return plainMesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2, 1, 1, 2}).glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.cage.faceCount(), 1u);
                EXPECT_EQ(c.warnings, (Strings{"mesh 0 primitive 0: 1 triangle with a repeated vertex; left out"}));
            }),
        refused(
            "NaN positions", [nan] { return quadWithFloat(kPositions, 7, nan); },
            "mesh 0 primitive 0 POSITION[2]: not finite"),
        loaded(
            "quantized positions",
            [] {
                GltfBuilder b;
                b.addIntegers("VEC3", 5122, {0x8000, 0, 0, 32767, 0, 0, 0, 5, 0});
                b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0}}]}])";
                b.more = R"(,"extensionsRequired":["KHR_mesh_quantization"])";
                return b.glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.cage.positions, (std::vector<glm::vec3>{{-32768, 0, 0}, {32767, 0, 0}, {0, 5, 0}}));
            }),
        refused(
            "index 65535 of 16 bits",
            [] {
                GltfBuilder b;
                b.addFloats("VEC3", std::vector<float>(3 * 65536));
                b.addIntegers("SCALAR", 5123, {0, 1, 65535});
                b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])";
                return b.glb();
            },
            "mesh 0 primitive 0 indices[2]: 65535 is the restart value, which glTF 2.0 forbids"),
        loaded(
            "index 65535 of 32 bits",
            [] {
                std::vector<float> positions(3 * 65536);
                positions[3] = 1;
                positions[3 * 65535 + 1] = 1;
                return plainMesh(positions, {0, 1, 65535}).glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.cage.sourceVertices, (std::vector<uint32_t>{0, 1, 65535}));
                EXPECT_EQ(c.cage.positions[2], glm::vec3(0, 1, 0));
            }),
        refused(
            "BIN chunk of 0 bytes, needed", [] { return withEmptyBinChunk(skinnedQuad().json()); },
            "buffer 0: the GLB has no binary chunk or an empty one"),
        loaded(
            "BIN chunk of 0 bytes, not needed",
            [] {
                const GltfBuilder b = skinnedQuad();
                return withEmptyBinChunk(b.json("data:application/octet-stream;base64," + base64(b.binary())));
            },
            [](const Character& c) { EXPECT_EQ(c.cage.vertexCount(), 4u); }),
        loaded(
            "data: URI with spaces",
            [] {
                const GltfBuilder b = skinnedQuad();
                std::string text = base64(b.binary());
                for (size_t i = 10; i < text.size(); i += 31) {
                    text.insert(i, "  ");
                }
                return toBytes(b.json("data: application/octet-stream ;base64, " + text));
            },
            [](const Character& c) { EXPECT_EQ(c.cage.positions[2], glm::vec3(1, 1, 0)); }),
    };
}

/// In the shapes of Khronos' glTF-Validator corpus; the names are its.
std::vector<Nasty> validatorShapes() {
    const std::string tip = R"({"name":"tip","translation":[1,0,0]})";
    const std::string rotation = R"({"sampler":0,"target":{"node":2,"path":"rotation"}})";
    return {
        refused(
            "skin: ibm_invalid_count",
            [] {
                return quadReplacing(R"({"joints":[1,2],"inverseBindMatrices":4})",
                                     R"({"joints":[1,2,0],"inverseBindMatrices":4})");
            },
            "skin 0 inverseBindMatrices: 2 matrices for 3 joints"),
        loaded(
            "skin: no_common_root",
            [] { return quadReplacing(R"({"name":"root","children":[2]})", R"({"name":"root"})"); },
            [](const Character& c) {
                EXPECT_EQ(c.skin.joints, (std::vector<uint32_t>{1, 2}));
                EXPECT_EQ(c.skeleton.nodes[1].parent, kNone) << "two trees; every joint has its own way up";
                EXPECT_EQ(c.skeleton.nodes[2].parent, kNone);
            }),
        refused(
            "skin: unresolved_joint", [] { return quadReplacing(R"("joints":[1,2])", R"("joints":[1,9])"); },
            "skin 0 joints[1]: node 9 is out of range: the file has 3"),
        loaded(
            "skin: buffer_view_bytestride",
            [] {
                // 80 bytes apart: the last row of one matrix would be read into the next if the stride were not kept.
                GltfBuilder b = skinnedQuad();
                std::vector<float> floats(36, 7.0f);
                for (size_t m = 0; m < 2; ++m) {
                    for (size_t k = 0; k < 16; ++k) {
                        floats[20 * m + k] = k % 5 == 0 ? 1.0f : 0.0f;
                    }
                    floats[20 * m + 12] = -static_cast<float>(m + 1);
                }
                const int view = b.addFloats("SCALAR", floats);
                const std::string length = std::to_string(4 * floats.size());
                std::string json = b.json();
                json = replaced(json, R"("byteLength":144})", R"("byteLength":144,"byteStride":80})");
                return packGlb(replaced(json, R"({"bufferView":4,"componentType":5126,"count":2,"type":"MAT4"})",
                                        R"({"bufferView":)" + std::to_string(view) +
                                            R"(,"componentType":5126,"count":2,"type":"MAT4"})"),
                               b.binary());
            },
            [](const Character& c) {
                EXPECT_EQ(c.skin.inverseBinds[0][3], glm::vec4(-1, 0, 0, 1));
                EXPECT_EQ(c.skin.inverseBinds[1][3], glm::vec4(-2, 0, 0, 1));
                EXPECT_EQ(c.skin.inverseBinds[1][0], glm::vec4(1, 0, 0, 0));
            }),
        refused(
            "skin_data: invalid_ibm", [] { return quadWithFloat(kInverseBinds, 16 + 11, 0.5f); },
            "skin 0 inverseBindMatrices[1]: last row is not 0 0 0 1"),
        loaded(
            "mesh_data: joints_weights_complex",
            [] {
                // A joint named twice, a joint out of range without weight, sums that are not 1.
                return skinnedTriangle(2, {{1, 1, 0, 0, 0, 77, 0, 0, 0, 1, 0, 0}},
                                       {{0.25f, 0.5f, 0.25f, 0, 1, 0, 0, 0, 2, 2, 0, 0}})
                    .glb();
            },
            [](const Character& c) {
                ASSERT_EQ(c.weights.starts, (std::vector<uint32_t>{0, 2, 3, 5}));
                EXPECT_EQ(c.weights.influences[1].joint, 1u);
                EXPECT_EQ(c.weights.influences[1].weight, 0.75f);
                EXPECT_EQ(c.weights.influences[3].weight, 0.5f);
                EXPECT_EQ(c.warnings.size(), 1u);
            }),
        refused(
            "mesh_data: joints_weights_complex, negative", [] { return quadWithFloat(kWeights, 4, -0.5f); },
            "mesh 0 primitive 0 WEIGHTS_0[1]: negative"),
        refused(
            "mesh_data: joints_no_weights", [] { return quadReplacing(R"(,"WEIGHTS_0":2)", ""); },
            "mesh 0 primitive 0: JOINTS_0 without WEIGHTS_0"),
        refused(
            "mesh: unequal_joints, within a primitive",
            [] { return quadReplacing(R"("JOINTS_0":1)", R"("JOINTS_0":1,"JOINTS_1":1)"); },
            "mesh 0 primitive 0: JOINTS_1 without WEIGHTS_1"),
        loaded(
            "mesh: unequal_joints, between primitives",
            [] {
                GltfBuilder b = skinnedQuad();
                const int first = b.addIntegers("SCALAR", 5121, {0, 1, 2});
                const int second = b.addIntegers("SCALAR", 5121, {0, 2, 3});
                const std::string zeros = std::to_string(b.addFloats("VEC4", std::vector<float>(16)));
                b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":)" +
                           std::to_string(first) +
                           R"(},{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2,"JOINTS_1":1,"WEIGHTS_1":)" +
                           zeros + R"(},"indices":)" + std::to_string(second) + "}]}]";
                return b.glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.cage.vertexCount(), 4u) << "a set of zeros changes no skin";
                EXPECT_EQ(topologyFault(c), "");
            }),
        refused(
            "mesh: morph_weights_wrong_count",
            [] { return quadReplacing(R"("mode":4}])", R"("targets":[{"POSITION":0}]}],"weights":[0.5,0.5])"); },
            "mesh 0 weights: 2 weights for 1 morph target"),
        refused(
            "animation: sampler_too_few_cubic_frames",
            [] {
                return quadWithRotations("CUBICSPLINE", {0}, {0, 0, 0, 1});
            },
            "animation 0 channel 0 input: CUBICSPLINE needs at least two keys"),
        refused(
            "animation: sampler_output_count_invalid",
            [] {
                return quadWithRotations("LINEAR", {0, 1}, {0, 0, 0, 1});
            },
            "animation 0 channel 0 output: 1 element for 2 keys"),
        refused(
            "animation: channel_node_matrix",
            [tip] { return quadReplacing(tip, R"({"name":"tip","matrix":[1,0,0,0,0,1,0,0,0,0,1,0,1,0,0,1]})"); },
            "animation 0 channel 0: animates node 2, which has a matrix\n"
            "nasty.glb: animation 0 channel 1: animates node 2, which has a matrix"),
        refused(
            "animation: channel_duplicate_targets",
            [rotation] { return quadReplacing(rotation, rotation + "," + rotation); },
            "animation 0 channel 1: a second channel for rotation of node 2"),
        loaded(
            "animation_data: invalid_input_values, negative", [] { return quadWithFloat(kTimes, 0, -1.0f); },
            [](const Character& c) {
                EXPECT_EQ(c.clips[0].duration, 3.0);
                EXPECT_EQ(c.warnings, Strings{"animation 0: keys before 0; its time begins at its first key, -1 s"});
            }),
        refused(
            "animation_data: invalid_input_values, not finite",
            [] { return quadWithFloat(kTimes, 2, std::numeric_limits<float>::infinity()); },
            "animation 0 channel 0 input[2]: not finite\n"
            "nasty.glb: animation 0 channel 1 input[2]: not finite"),
        loaded(
            "animation_data: quaternion_cubic_non_unit_values",
            [] {
                return quadWithRotations("CUBICSPLINE", {0, 1}, {9, 0, 0, 0, 0, 0, 0, 2, 0, 9, 0, 0, //
                                                                 0, 0, 9, 0, 0, 0, 3, 0, 0, 0, 0, 9});
            },
            [](const Character& c) {
                // A spline's values are normalised after they are interpolated, not before.
                EXPECT_EQ(c.clips[0].channels[0].values[7], 2.0f);
                EXPECT_EQ(c.clips[0].channels[0].values[18], 3.0f);
            }),
        refused(
            "accessor: invalid_sparse_count",
            [] {
                return quadReplacing(
                    R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})",
                    R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":5,)"
                    R"("indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":0}}})");
            },
            "accessor 0 sparse count: 5 is not in 1..4"),
        refused(
            "accessor: invalid stride",
            [] {
                return quadReplacing(R"({"buffer":0,"byteOffset":0,"byteLength":48})",
                                     R"({"buffer":0,"byteOffset":0,"byteLength":48,"byteStride":3})");
            },
            "bufferView 0 byteStride: 3 is not a multiple of 4 in 4..252"),
        refused(
            "node: node_skin_without_skinned_mesh", [] { return quadReplacing(R"("JOINTS_0":1,"WEIGHTS_0":2,)", ""); },
            "mesh 0 primitive 0: no JOINTS_0 and WEIGHTS_0, but its node has a skin"),
    };
}

/// Extensions and options that readers have stumbled over.
std::vector<Nasty> extensionShapes() {
    return {
        refused(
            "unknown extension, required",
            [] { return quadReplacing(R"("scene":0)", R"("scene":0,"extensionsRequired":["ACME_soft_body"])"); },
            "extensionsRequired: ACME_soft_body is not supported"),
        loaded(
            "unknown extension, used",
            [] {
                return quadReplacing(R"("mode":4)", R"("extensions":{"ACME_soft_body":{"a":[1,{"b":null}]}},"mode":4)");
            },
            [](const Character& c) { EXPECT_EQ(c.warnings, Strings()); }),
        loaded(
            "KHR_animation_pointer",
            [] {
                return quadReplacing(R"({"sampler":0,"target":{"node":2,"path":"rotation"}})",
                                     R"({"sampler":0,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":)"
                                     R"({"pointer":"/nodes/2/rotation"}}}})");
            },
            [](const Character& c) {
                EXPECT_EQ(c.clips[0].channels.size(), 2u);
                EXPECT_EQ(c.warnings, Strings());
            }),
        loaded(
            "EXT_mesh_gpu_instancing",
            [] {
                return quadReplacing(R"({"mesh":0,"skin":0})",
                                     R"({"mesh":0,"skin":0,"extensions":{"EXT_mesh_gpu_instancing":)"
                                     R"({"attributes":{"TRANSLATION":7}}}})");
            },
            [](const Character& c) { EXPECT_EQ(c.cage.vertexCount(), 4u) << "how many there are is the host's"; }),
        loaded(
            "triangle soup of a closed surface",
            [] {
                std::vector<float> soup;
                for (const int v : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) {
                    soup.insert(soup.end(), {kTetrahedron[v].x, kTetrahedron[v].y, kTetrahedron[v].z});
                }
                GltfBuilder b;
                b.addFloats("VEC3", soup);
                b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0}}]}])";
                return b.glb();
            },
            [](const Character& c) {
                EXPECT_EQ(c.cage.vertexCount(), 4u);
                EXPECT_EQ(c.seamVertexCount, 8u);
                EXPECT_EQ(c.cage.sourceVertices, (std::vector<uint32_t>{0, 1, 2, 5}));
                EXPECT_EQ(topologyFault(c), "");
            }),
    };
}

class GltfNasty : public testing::TestWithParam<Nasty> {};

TEST_P(GltfNasty, ReadsRightOrIsRefusedByName) {
    const Nasty& nasty = GetParam();
    // What a strict reading refuses, another one may mend: lenient_test.cpp says how.
    const Result<Character> result =
        readGltf(nasty.file(), "nasty.glb", "", nasty.refusal.empty() ? kKeepTriangles : kStrict);
    std::string warnings;
    if (result.ok()) {
        for (const std::string& warning : result->warnings) {
            warnings += "; " + warning;
        }
    }
    std::printf("  %-50s %s\n", nasty.item,
                result.ok() ? ("loaded" + warnings).c_str() : ("refused: " + result.error().message).c_str());
    if (!nasty.refusal.empty()) {
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.error().message, "nasty.glb: " + nasty.refusal);
        return;
    }
    ASSERT_TRUE(result.ok()) << result.error().message;
    nasty.check(*result);
}

std::string nameOf(const testing::TestParamInfo<Nasty>& info) {
    std::string name;
    for (const char c : std::string(info.param.item)) {
        name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    }
    return name;
}

INSTANTIATE_TEST_SUITE_P(List, GltfNasty, testing::ValuesIn(nastyList()), nameOf);
INSTANTIATE_TEST_SUITE_P(Validator, GltfNasty, testing::ValuesIn(validatorShapes()), nameOf);
INSTANTIATE_TEST_SUITE_P(Extensions, GltfNasty, testing::ValuesIn(extensionShapes()), nameOf);

} // namespace
} // namespace supple::cage
