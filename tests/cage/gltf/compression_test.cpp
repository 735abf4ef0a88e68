// Positions and texture coordinates as integers, and bufferViews compressed by meshoptimizer.
#include "tests/cage/gltf/compressed.h"
#include "tests/cage/gltf/reading.h"

#include <gtest/gtest.h>

namespace supple::cage {
namespace {

using namespace test;

// ---- KHR_mesh_quantization ------------------------------------------------------------------------------------------

constexpr const char* kRequired = R"(,"extensionsRequired":["KHR_mesh_quantization"])";

GltfBuilder quantizedTriangle(int componentType, const std::vector<uint32_t>& positions, bool normalized,
                              const std::string& more = kRequired) {
    GltfBuilder b;
    b.addIntegers("VEC3", componentType, positions, normalized);
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0}}]}])";
    b.more = more;
    return b;
}

TEST(GltfCompression, QuantizedPositions) {
    struct Case {
        int componentType;
        bool normalized;
        std::vector<uint32_t> bits;
        std::vector<glm::vec3> positions;
    };
    const Case cases[] = {
        {5120, false, {0x80, 0, 0, 127, 0, 0, 0, 0xFF, 0}, {{-128, 0, 0}, {127, 0, 0}, {0, -1, 0}}},
        {5121, false, {0, 0, 0, 255, 0, 0, 0, 7, 0}, {{0, 0, 0}, {255, 0, 0}, {0, 7, 0}}},
        {5122, false, {0x8000, 0, 0, 32767, 0, 0, 0, 0xFFFF, 0}, {{-32768, 0, 0}, {32767, 0, 0}, {0, -1, 0}}},
        {5123, false, {0, 0, 0, 65535, 0, 0, 0, 7, 0}, {{0, 0, 0}, {65535, 0, 0}, {0, 7, 0}}},
        {5120, true, {0x80, 0, 0, 127, 0, 0, 0, 0x81, 0}, {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}}},
        {5121, true, {0, 0, 0, 255, 0, 0, 0, 51, 0}, {{0, 0, 0}, {1, 0, 0}, {0, 0.2f, 0}}},
        {5122, true, {0x8000, 0, 0, 32767, 0, 0, 0, 0x8001, 0}, {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}}},
        {5123, true, {0, 0, 0, 65535, 0, 0, 0, 13107, 0}, {{0, 0, 0}, {1, 0, 0}, {0, 0.2f, 0}}},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(std::to_string(c.componentType) + (c.normalized ? " normalized" : ""));
        EXPECT_EQ(readWell(quantizedTriangle(c.componentType, c.bits, c.normalized).glb()).cage.positions, c.positions);
        EXPECT_EQ(readWell(quantizedTriangle(c.componentType, c.bits, c.normalized,
                                             R"(,"extensionsUsed":["KHR_mesh_quantization"])")
                               .glb())
                      .cage.positions,
                  c.positions);
    }
    EXPECT_EQ(messageOf(quantizedTriangle(5122, {0, 0, 0, 1, 0, 0, 0, 1, 0}, false, "").glb()),
              "t.glb: mesh 0 primitive 0 POSITION: SHORT components need KHR_mesh_quantization, which the file does "
              "not declare");
    EXPECT_EQ(messageOf(quantizedTriangle(5125, {0, 0, 0, 1, 0, 0, 0, 1, 0}, false).glb()),
              "t.glb: mesh 0 primitive 0 POSITION: UNSIGNED_INT components are not allowed here");
}

TEST(GltfCompression, QuantizedVerticesAreWelded) {
    // Two triangles of a quad in units of the grid; the node gives them their size back.
    GltfBuilder b;
    b.addIntegers("VEC3", 5123, {100, 100, 0, 300, 100, 0, 300, 300, 0, 100, 100, 0, 300, 300, 0, 100, 300, 0});
    b.addIntegers("VEC2", 5122, {0, 0, 0x8000, 0, 0x8000, 7, 0, 0, 0x8000, 7, 0, 7});
    b.addIntegers("VEC3", 5120, {0, 0, 1, 0, 0, 0, 0, 0, 0xFF, 0, 0, 1, 0, 0, 0xFF, 0, 0, 0});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"targets":[{"POSITION":2}]}]}])";
    b.nodes = R"([{"mesh":0,"scale":[0.01,0.01,0.01]}])";
    b.more = kRequired;
    const Character c = readWell(b.glb());
    EXPECT_EQ(c.warnings, Strings());
    EXPECT_EQ(c.cage.vertexCount(), 4u);
    EXPECT_EQ(c.cage.positions[2], glm::vec3(300, 300, 0));
    EXPECT_EQ(c.cage.cornerUvs[1], glm::vec2(-32768, 0));
    EXPECT_EQ(c.morphs.targets[0].deltas, (std::vector<glm::vec3>{{0, 0, 1}, {0, 0, -1}}));
    EXPECT_EQ(c.skin.joints, std::vector<uint32_t>{0}) << "the node that dequantizes is the joint";

    // Displacements are signed.
    GltfBuilder unsignedDeltas = b;
    unsignedDeltas.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":0}]}]}])";
    EXPECT_EQ(messageOf(unsignedDeltas.glb()),
              "t.glb: mesh 0 primitive 0 target 0 POSITION: UNSIGNED_SHORT components are not allowed here");
}

// ---- meshopt --------------------------------------------------------------------------------------------------------

/// A strip of quads, in the order of FB_ngon_encoding, skinned to two joints and animated.
GltfBuilder longStrip() {
    constexpr uint32_t kQuads = 100;
    GltfBuilder b;
    std::vector<float> positions;
    std::vector<uint32_t> joints;
    std::vector<float> weights;
    std::vector<uint32_t> indices;
    for (uint32_t i = 0; i <= kQuads; ++i) {
        for (uint32_t side = 0; side < 2; ++side) {
            const auto x = static_cast<float>(i);
            positions.insert(positions.end(), {x, static_cast<float>(side), 0.25f * x});
            joints.insert(joints.end(), {0, 1, 0, 0});
            weights.insert(weights.end(), {1.0f - x / kQuads, x / kQuads, 0, 0});
        }
        if (i < kQuads) {
            const uint32_t v = 2 * i;
            indices.insert(indices.end(), {v, v + 2, v + 3, v, v + 3, v + 1});
        }
    }
    b.addFloats("VEC3", positions);
    b.addIntegers("VEC4", 5121, joints);
    b.addFloats("VEC4", weights);
    b.addIntegers("SCALAR", 5123, indices);
    b.addFloats("SCALAR", {0, 1, 2, 3, 4});
    b.addFloats("VEC4", {0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0.6f, 0, 0, 0.8f});
    b.addFloats("VEC3", {0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 0.5f, 0.25f, -1});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3,)"
               R"("extensions":{"FB_ngon_encoding":{}}}]}])";
    b.nodes = R"([{"mesh":0,"skin":0},{},{}])";
    b.more = R"(,"skins":[{"joints":[1,2]}],"animations":[{"samplers":[{"input":4,"output":5},{"input":4,"output":6}],)"
             R"("channels":[{"sampler":0,"target":{"node":1,"path":"rotation"}},{"sampler":1,"target":{"node":1,)"
             R"("path":"translation"}}]}])";
    return b;
}

Strings compressionWarning(const std::string& extension, int views) {
    return {extension + ": " + std::to_string(views) +
            " bufferViews are compressed: such files usually had their triangles and vertices reordered, and polygons "
            "that are read from that order are lost"};
}

TEST(GltfCompression, MeshoptDecodesToTheSame) {
    const Character plain = readWell(longStrip().glb());
    ASSERT_EQ(plain.cage.faceCount(), 100u);
    for (const std::string extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        for (const bool tagged : {true, false}) {
            SCOPED_TRACE(extension);
            const std::vector<std::byte> bytes = compressed(longStrip(), extension, {.tagPlaceholder = tagged});
            EXPECT_LT(bytes.size(), longStrip().glb().size());
            const Character c = readWell(bytes);
            EXPECT_EQ(c.warnings, compressionWarning(extension, 7));
            EXPECT_EQ(c.parts[0].polygonSource, PolygonSource::ngonEncoding);
            EXPECT_EQ(c.cage.positions, plain.cage.positions);
            EXPECT_EQ(c.cage.faceVertices, plain.cage.faceVertices);
            EXPECT_EQ(c.cage.faceStarts, plain.cage.faceStarts);
            ASSERT_EQ(c.weights.influences.size(), plain.weights.influences.size());
            for (size_t i = 0; i < c.weights.influences.size(); ++i) {
                EXPECT_EQ(c.weights.influences[i].joint, plain.weights.influences[i].joint);
                EXPECT_EQ(c.weights.influences[i].weight, plain.weights.influences[i].weight);
            }
            ASSERT_EQ(c.clips.size(), 1u);
            for (size_t k = 0; k < 2; ++k) {
                EXPECT_EQ(c.clips[0].channels[k].times, plain.clips[0].channels[k].times);
                EXPECT_EQ(c.clips[0].channels[k].values, plain.clips[0].channels[k].values);
            }
        }
    }
    // Indices that are no triangle list, or not taken for one.
    EXPECT_EQ(readWell(compressed(longStrip(), "EXT_meshopt_compression", {.sequences = true})).cage.faceVertices,
              plain.cage.faceVertices);
}

TEST(GltfCompression, MeshoptFilters) {
    const std::vector<std::byte> bytes =
        compressed(longStrip(), "EXT_meshopt_compression", {.exponential = {6}, .quaternions = {5}});
    const Character plain = readWell(longStrip().glb());
    const Character c = readWell(bytes);
    ASSERT_EQ(c.clips.size(), 1u);
    for (size_t k = 0; k < 2; ++k) {
        const auto& values = c.clips[0].channels[k].values;
        const auto& expected = plain.clips[0].channels[k].values;
        ASSERT_EQ(values.size(), expected.size());
        for (size_t i = 0; i < values.size(); ++i) {
            // A quaternion comes back as itself or its negative.
            const float difference = k == 0 ? std::abs(values[i]) - std::abs(expected[i]) : values[i] - expected[i];
            EXPECT_NEAR(difference, 0.0f, k == 0 ? 1e-4f : 1e-6f) << k << " " << i;
        }
    }
}

TEST(GltfCompression, PlaceholdersAreNotRead) {
    // The uncompressed buffer may be there, for readers that do not decode; it is not asked for.
    std::vector<std::string> asked;
    GltfOptions options;
    options.readFile = [&](const std::string& path) -> Result<std::vector<std::byte>> {
        asked.push_back(path);
        return Error{ErrorCode::io, "no"};
    };
    const auto bytes = compressed(longStrip(), "EXT_meshopt_compression", {.placeholderUri = "whole.bin"});
    EXPECT_TRUE(readGltf(bytes, "t.glb", "", options).ok());
    EXPECT_TRUE(asked.empty());
    // What is needed of it is.
    const auto partly =
        compressed(longStrip(), "EXT_meshopt_compression", {.placeholderUri = "whole.bin", .plainView = 4});
    EXPECT_FALSE(readGltf(partly, "t.glb", "", options).ok());
    EXPECT_EQ(asked, Strings{"whole.bin"});
    EXPECT_EQ(messageOf(compressed(longStrip(), "EXT_meshopt_compression", {.plainView = 4})),
              "t.glb: buffer 1: no uri");
}

TEST(GltfCompression, MeshoptRefusals) {
    const std::vector<std::byte> good = compressed(longStrip(), "EXT_meshopt_compression");
    const auto with = [&](const std::string& view, const nlohmann::json& change, ErrorCode code = ErrorCode::asset) {
        return messageOf(
            changed(good,
                    [&](nlohmann::json& root) {
                        root["bufferViews"][std::stoul(view)]["extensions"]["EXT_meshopt_compression"].update(change);
                    }),
            code);
    };
    const std::string name = "t.glb: bufferView 0 EXT_meshopt_compression";
    EXPECT_EQ(with("0", {{"buffer", 2}}), name + " buffer: buffer 2 is out of range: the file has 2");
    EXPECT_NE(with("0", {{"byteOffset", 1u << 30}}).find(name + ": bytes 1073741824 + "), std::string::npos);
    EXPECT_NE(with("0", {{"byteLength", 18446744073709551615u}}).find("are out of range: the buffer has"),
              std::string::npos);
    EXPECT_NE(with("0", {{"byteLength", 0}}).find("are out of range: the buffer has"), std::string::npos);
    EXPECT_EQ(with("0", {{"mode", "POINTS"}}), name + " mode: \"POINTS\" is not allowed");
    EXPECT_EQ(with("0", {{"mode", 4}}), name + " mode: not a string");
    EXPECT_EQ(with("0", {{"byteStride", 6}}), name + " byteStride: 6 is not allowed in mode ATTRIBUTES");
    EXPECT_EQ(with("0", {{"byteStride", 260}}), name + " byteStride: 260 is not allowed in mode ATTRIBUTES");
    EXPECT_EQ(with("0", {{"byteStride", 0}}), name + " byteStride: 0 is not allowed in mode ATTRIBUTES");
    EXPECT_EQ(with("0", {{"filter", "COLOR"}}),
              name + " filter: \"COLOR\" is not supported in mode ATTRIBUTES with a byteStride of 12");
    EXPECT_EQ(with("0", {{"filter", "QUATERNION"}}),
              name + " filter: \"QUATERNION\" is not supported in mode ATTRIBUTES with a byteStride of 12");
    EXPECT_EQ(with("3", {{"filter", "EXPONENTIAL"}}),
              "t.glb: bufferView 3 EXT_meshopt_compression filter: \"EXPONENTIAL\" is not supported in mode TRIANGLES "
              "with a byteStride of 2");
    EXPECT_EQ(with("3", {{"count", 601}}),
              "t.glb: bufferView 3 EXT_meshopt_compression count: 601 is not a multiple of 3");
    EXPECT_EQ(with("0", {{"count", 203}}), name + ": decodes to 2436 bytes, but its bufferView has 2424");
    EXPECT_NE(with("0", {{"count", 4000000000u}}).find(name + " count: 4000000000 elements cannot be in "),
              std::string::npos);
    EXPECT_NE(with("0", {{"count", 18446744073709551615u}}).find("elements cannot be in "), std::string::npos);
    EXPECT_NE(with("0", {{"count", 0}}).find("count: 0 elements cannot be in "), std::string::npos);
    EXPECT_EQ(with("0", {{"mode", "TRIANGLES"}, {"byteStride", 4}, {"count", 606}}),
              name + ": its compressed bytes are damaged");

    // The first byte of each codec is its name and version.
    const auto firstByte = [&](size_t view, std::byte value) {
        std::vector<std::byte> bytes = good;
        const nlohmann::json root = jsonOf(good);
        const auto& extension = root["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
        bytes[binaryOffset(good) + extension["byteOffset"].get<size_t>()] = value;
        return messageOf(bytes);
    };
    EXPECT_EQ(firstByte(0, std::byte{0xA1}),
              name + ": version 1 of its vertex codec is not supported; export the mesh uncompressed");
    EXPECT_EQ(firstByte(0, std::byte{0xB0}), name + ": its compressed bytes are damaged");
    EXPECT_EQ(firstByte(3, std::byte{0xA0}),
              "t.glb: bufferView 3 EXT_meshopt_compression: its compressed bytes are damaged");
    EXPECT_EQ(
        messageOf(changed(
            good, [](nlohmann::json& root) { root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = 7; })),
        name + ": not an object");
    EXPECT_EQ(messageOf(changed(good,
                                [](nlohmann::json& root) {
                                    root["bufferViews"][0].erase("extensions");
                                    root["bufferViews"][0]["buffer"] = 2;
                                })),
              "t.glb: bufferView 0 buffer: buffer 2 is out of range: the file has 2")
        << "decoded buffers are nobody else's";
}

TEST(GltfCompression, DecodedBytesAreBounded) {
    // Many views of the same few compressed bytes, all zeros.
    constexpr size_t kCount = size_t{1} << 20;
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    b.addFloats("VEC4", std::vector<float>(4 * kCount));
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0}}]}])";
    const auto bytes = changed(compressed(b, "EXT_meshopt_compression"), [](nlohmann::json& root) {
        for (int i = 0; i < 64; ++i) {
            root["bufferViews"].push_back(root["bufferViews"][1]);
        }
    });
    EXPECT_LT(bytes.size(), size_t{1} << 20);
    EXPECT_EQ(
        messageOf(bytes, ErrorCode::limit),
        "t.glb: bufferView 64 EXT_meshopt_compression: the file's compressed data decodes to more than 1073741824 "
        "bytes");
}

} // namespace
} // namespace supple::cage
