// KHR_draco_mesh_compression: what Draco's own encoder writes, whole and damaged.
#include "tests/cage/gltf/draco.h"
#include "tests/cage/gltf/reading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace supple::cage {
namespace {

using namespace test;

/// A wavy sheet of size * size quads in [0, 1], skinned to two joints, with texture coordinates. One accessor each.
GltfBuilder sheet(uint32_t size) {
    GltfBuilder b;
    std::vector<float> positions, uvs, weights;
    std::vector<uint32_t> joints, indices;
    for (uint32_t j = 0; j <= size; ++j) {
        for (uint32_t i = 0; i <= size; ++i) {
            const float x = static_cast<float>(i) / static_cast<float>(size);
            const float y = static_cast<float>(j) / static_cast<float>(size);
            positions.insert(positions.end(), {x, y, 0.2f * std::sin(6.0f * x) * std::cos(5.0f * y)});
            uvs.insert(uvs.end(), {x, 1.0f - y});
            joints.insert(joints.end(), {0, 1, 0, 0});
            weights.insert(weights.end(), {1.0f - x, x, 0, 0});
            const uint32_t v = j * (size + 1) + i;
            if (i < size && j < size) {
                indices.insert(indices.end(), {v, v + 1, v + size + 2, v, v + size + 2, v + size + 1});
            }
        }
    }
    b.addFloats("VEC3", positions);
    b.addFloats("VEC2", uvs);
    b.addIntegers("VEC4", 5121, joints);
    b.addFloats("VEC4", weights);
    b.addIntegers("SCALAR", 5125, indices);
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1,"JOINTS_0":2,"WEIGHTS_0":3},)"
               R"("indices":4}]}])";
    b.nodes = R"([{"mesh":0,"skin":0},{},{}])";
    b.more = R"(,"skins":[{"joints":[1,2]}])";
    return b;
}

/// The second primitive is the first one's twin.
GltfBuilder twoSheets() {
    GltfBuilder b = sheet(4);
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1,"JOINTS_0":2,"WEIGHTS_0":3},)"
               R"("indices":4},{"attributes":{"POSITION":0},"indices":4}]}])";
    b.nodes = R"([{"mesh":0}])";
    b.more = "";
    return b;
}

std::string warningOf(const std::string& primitives) {
    return "KHR_draco_mesh_compression: " + primitives +
           " compressed: positions are rounded, and vertices and triangles are usually reordered, so that polygons "
           "that are read from that order are lost";
}

/// Triangles by their corners' places on a grid of thousandths, each begun at its smallest corner: all in rising order.
std::vector<std::array<std::array<int, 5>, 3>> trianglesOf(const Character& c) {
    std::vector<std::array<std::array<int, 5>, 3>> triangles;
    for (uint32_t f = 0; f < c.cage.faceCount(); ++f) {
        std::array<std::array<int, 5>, 3> triangle{};
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t corner = c.cage.faceStarts[f] + k;
            const glm::vec3 p = c.cage.positions[c.cage.faceVertices[corner]];
            const glm::vec2 uv = c.cage.cornerUvs[corner];
            triangle[k] = {static_cast<int>(std::lround(p.x * 100)), static_cast<int>(std::lround(p.y * 100)),
                           static_cast<int>(std::lround(p.z * 10)), static_cast<int>(std::lround(uv.x * 100)),
                           static_cast<int>(std::lround(uv.y * 100))};
        }
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
        triangles.push_back(triangle);
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

/// A byte of a primitive's encoded mesh changed.
std::vector<std::byte> withByte(std::vector<std::byte> glb, size_t byte, uint8_t value, size_t primitive = 0) {
    const nlohmann::json root = jsonOf(glb);
    const auto& extension = root["meshes"][0]["primitives"][primitive]["extensions"]["KHR_draco_mesh_compression"];
    const auto& view = root["bufferViews"][extension["bufferView"].get<size_t>()];
    glb[binaryOffset(glb) + view["byteOffset"].get<size_t>() + byte] = static_cast<std::byte>(value);
    return glb;
}

TEST(GltfDraco, SequentialKeepsTheOrder) {
    const Character plain = readWell(sheet(6));
    const Character c = readWell(dracoCompressed(sheet(6), {.sequential = true}));
    EXPECT_EQ(c.warnings, Strings{warningOf("1 primitive is")});
    EXPECT_EQ(c.cage.faceVertices, plain.cage.faceVertices);
    ASSERT_EQ(c.cage.vertexCount(), plain.cage.vertexCount());
    for (uint32_t v = 0; v < c.cage.vertexCount(); ++v) {
        EXPECT_LT(glm::length(c.cage.positions[v] - plain.cage.positions[v]), 2.0f / 16384.0f);
    }
    ASSERT_EQ(c.weights.influences.size(), plain.weights.influences.size());
    for (size_t i = 0; i < c.weights.influences.size(); ++i) {
        EXPECT_EQ(c.weights.influences[i].joint, plain.weights.influences[i].joint);
        EXPECT_NEAR(c.weights.influences[i].weight, plain.weights.influences[i].weight, 1e-6f);
    }
}

TEST(GltfDraco, EdgebreakerHasTheSameTriangles) {
    const Character plain = readWell(sheet(10));
    const std::vector<std::byte> bytes = dracoCompressed(sheet(10));
    const Character c = readWell(bytes);
    EXPECT_EQ(c.warnings, Strings{warningOf("1 primitive is")});
    EXPECT_EQ(trianglesOf(c), trianglesOf(plain));
    for (uint32_t v = 0; v < c.cage.vertexCount(); ++v) {
        for (uint32_t i = c.weights.starts[v]; i < c.weights.starts[v + 1]; ++i) {
            const Influence& influence = c.weights.influences[i];
            const float x = c.cage.positions[v].x;
            EXPECT_NEAR(influence.weight, influence.joint == 0 ? 1.0f - x : x, 1e-3f);
        }
    }
    // Not strict only by what it says.
    EXPECT_EQ(messageOf(bytes), "accepted");
}

TEST(GltfDraco, WhatIsNotCompressedIsToldIfVerticesAreReordered) {
    const std::string said = "mesh 0 primitive 0 KHR_draco_mesh_compression: vertices are in another order than before "
                             "they were compressed; what is not compressed must have that order, and is taken as it "
                             "stands: ";
    const Character c = readWell(dracoCompressed(sheet(6), {.apart = "TEXCOORD_0"}));
    EXPECT_EQ(c.warnings, (Strings{said + "TEXCOORD_0", warningOf("1 primitive is")}));
    EXPECT_EQ(c.cage.cornerUvs.size(), c.cage.faceVertices.size());
    EXPECT_EQ(readWell(dracoCompressed(sheet(6), {.sequential = true, .apart = "TEXCOORD_0"})).warnings,
              Strings{warningOf("1 primitive is")});
    GltfBuilder moved = sheet(6);
    const std::string target = std::to_string(moved.addFloats("VEC3", std::vector<float>(size_t{3} * 49, 0.5f)));
    moved.meshes.insert(moved.meshes.size() - 4, R"(,"targets":[{"POSITION":)" + target + "}]");
    EXPECT_EQ(readWell(dracoCompressed(moved)).warnings,
              (Strings{said + "morph targets", warningOf("1 primitive is")}));
}

TEST(GltfDraco, BytesThatNeedNoDecodingAreTaken) {
    const Character plain = readWell(sheet(4));
    const Character c = readWell(dracoCompressed(sheet(4), {.fallback = true}));
    EXPECT_EQ(c.warnings, Strings());
    EXPECT_EQ(c.cage.positions, plain.cage.positions);
    EXPECT_EQ(c.cage.faceVertices, plain.cage.faceVertices);
}

TEST(GltfDraco, EqualPrimitivesShareTheirVertices) {
    const std::vector<std::byte> bytes = changed(dracoCompressed(sheet(4)), [](nlohmann::json& root) {
        root["meshes"][0]["primitives"].push_back(root["meshes"][0]["primitives"][0]);
    });
    const std::string said = saidOf(bytes);
    EXPECT_TRUE(said.starts_with(warningOf("2 primitives are"))) << said;
    EXPECT_EQ(readWell(bytes).cage.vertexCount(), 25u);
}

TEST(GltfDraco, DamageCostsItsPrimitiveAlone) {
    const std::vector<std::byte> good = dracoCompressed(twoSheets());
    EXPECT_EQ(readWell(good).cage.vertexCount(), 50u);
    const std::vector<std::byte> bad = withByte(good, 0, 'X', 1);
    const std::string message = "mesh 0 primitive 1 KHR_draco_mesh_compression: its compressed bytes are not Draco's";
    const Character c = readWell(bad);
    EXPECT_EQ(c.cage.faceCount(), 32u);
    EXPECT_EQ(c.warnings, (Strings{warningOf("1 primitive is"), message + "; left out"}));
    EXPECT_EQ(messageOf(bad), "t.glb: " + message);
    // Where nothing else is left.
    EXPECT_EQ(saidOf(withByte(dracoCompressed(sheet(4)), 0, 'X')),
              "refused: t.glb: mesh 0 primitive 0 KHR_draco_mesh_compression: its compressed bytes are not Draco's");
}

TEST(GltfDraco, Refusals) {
    const std::vector<std::byte> good = dracoCompressed(sheet(4));
    const std::string place = "t.glb: mesh 0 primitive 0 KHR_draco_mesh_compression";
    EXPECT_EQ(messageOf(withByte(good, 6, 1)), place + ": version 2.1 of Draco's bit stream; glTF has 2.2");
    EXPECT_EQ(messageOf(withByte(good, 7, 0)), place + ": a point cloud: no triangles");
    EXPECT_EQ(messageOf(withByte(good, 8, 9)), place + ": an encoding that is not known");
    const auto with = [&](const std::function<void(nlohmann::json&)>& change) {
        return messageOf(changed(good, [&](nlohmann::json& root) {
            change(root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]);
        }));
    };
    EXPECT_EQ(with([](nlohmann::json& e) { e = 7; }), place + ": not an object");
    EXPECT_EQ(with([](nlohmann::json& e) { e["bufferView"] = 77; }),
              place + " bufferView: bufferView 77 is out of range: the file has 6");
    EXPECT_EQ(with([](nlohmann::json& e) { e.erase("attributes"); }), place + ": no attributes");
    EXPECT_EQ(with([](nlohmann::json& e) { e["attributes"].erase("POSITION"); }),
              place + ": no POSITION among its attributes");
    EXPECT_EQ(with([](nlohmann::json& e) { e["attributes"]["TEXCOORD_0"] = 9; }),
              place + ": TEXCOORD_0: no attribute 9 among the compressed ones");
    EXPECT_EQ(with([](nlohmann::json& e) { e["attributes"]["TEXCOORD_0"] = e["attributes"]["POSITION"]; }),
              place + ": TEXCOORD_0: 3 components are compressed, its accessor has 2");
    EXPECT_EQ(messageOf(changed(good, [](nlohmann::json& root) { root["accessors"][0]["count"] = 24; })),
              place + " POSITION: 25 elements are compressed, its accessor has 24");
    EXPECT_EQ(
        readWell(changed(good, [](nlohmann::json& root) { root["accessors"][0]["count"] = 24; })).cage.vertexCount(),
        25u);
}

/// A byte more or less makes a file that is read or refused, and never anything else.
TEST(GltfDraco, AnyDamageIsToldInOneLine) {
    for (const bool sequential : {false, true}) {
        const std::vector<std::byte> good = dracoCompressed(sheet(2), {.sequential = sequential});
        const nlohmann::json root = jsonOf(good);
        const size_t length = root["bufferViews"].back()["byteLength"];
        for (size_t byte = 0; byte < length; ++byte) {
            for (const uint8_t value : {0x00, 0xFF}) {
                const Result<Character> read = readGltf(withByte(good, byte, value), "t.glb", "", kKeepTriangles);
                EXPECT_TRUE(read.ok() || read.error().message.starts_with("t.glb: mesh 0 primitive 0"))
                    << (read.ok() ? "" : read.error().message);
            }
        }
    }
}

TEST(GltfDraco, ClaimsAreComparedWithTheFile) {
    const std::string place = "t.glb: mesh 0 primitive 0 KHR_draco_mesh_compression: ";
    // Behind the header of 11 bytes, and the traversal's kind: the counts, of 7 bits each.
    const auto claiming = [](bool sequential, const std::vector<uint8_t>& counts) {
        std::vector<std::byte> glb = dracoCompressed(sheet(12), {.sequential = sequential});
        for (size_t i = 0; i < counts.size(); ++i) {
            glb = withByte(glb, (sequential ? 11 : 12) + i, counts[i]);
        }
        return glb;
    };
    for (const bool sequential : {false, true}) {
        const std::string most = messageOf(
            claiming(sequential, {0xFF, 0xFF, 0xFF, 0xFF, 0x0F, 0xFF, 0xFF, 0xFF, 0xFF, 0x0F}), ErrorCode::limit);
        EXPECT_EQ(most, place + "more than 50331648 corners or 16777216 vertices");
        const std::string much =
            messageOf(claiming(sequential, {0xFF, 0xFF, 0x7F, 0xFF, 0xFF, 0x7F}), ErrorCode::limit);
        EXPECT_TRUE(much.starts_with(place + "the file needs more memory than")) << much;
    }
}

/// Attributes that nobody asks for take room while they are decoded.
TEST(GltfDraco, ManyAttributesAreCounted) {
    const std::vector<std::byte> few = dracoCompressed(sheet(40), {.positionBits = 1, .strideAttributes = 1});
    EXPECT_EQ(messageOf(few), "accepted");
    const std::vector<std::byte> many = dracoCompressed(sheet(40), {.positionBits = 1, .strideAttributes = 100});
    GltfOptions options = kStrict;
    options.memoryLimit = 4u << 20;
    EXPECT_EQ(messageOf(many, ErrorCode::limit, options),
              "t.glb: mesh 0 primitive 0 KHR_draco_mesh_compression: the file needs more memory than the 4194304 "
              "bytes of memoryLimit");
    EXPECT_EQ(messageOf(few, ErrorCode::limit, options), "accepted");
}

/// Dense meshes are small files of Draco's, and take what dense meshes take.
TEST(GltfDraco, DenseMeshesFitTheDefaultLimit) {
    const std::vector<std::byte> bytes = dracoCompressed(sheet(130));
    EXPECT_EQ(readWell(bytes).cage.vertexCount(), 131u * 131u) << bytes.size();
}

TEST(GltfDraco, ListsOfVerticesNeedTheirOrder) {
    const auto with = [](bool sequential) {
        GltfBuilder b = sheet(1);
        const std::string counts = std::to_string(b.addIntegers("SCALAR", 5121, {4}));
        const std::string corners = std::to_string(b.addIntegers("SCALAR", 5121, {0, 1, 3, 2}));
        b.meshes = replaced(b.meshes, R"("indices":4)",
                            R"("indices":4,"extensions":{"SUPPLE_mesh_cage":{"faceVertexCounts":)" + counts +
                                R"(,"faceVertexIndices":)" + corners + "}}");
        return dracoCompressed(b, {.sequential = sequential});
    };
    EXPECT_EQ(readWell(with(true)).cage.faceCount(), 1u);
    EXPECT_EQ(readWell(with(false)).cage.faceCount(), 2u);
    EXPECT_EQ(messageOf(with(false)),
              "t.glb: mesh 0 primitive 0 SUPPLE_mesh_cage: it counts vertices, and Draco has reordered them; let it "
              "encode the mesh sequentially");
}

} // namespace
} // namespace supple::cage
