// Damaged files are refused or read, never more. Worth most under the address and undefined behavior sanitizers.
#include "cage/gltf/reader.h"
#include "cage/materials.h"
#include "cage/topology.h"
#include "tests/cage/gltf/builder.h"
#include "tests/cage/gltf/compressed.h"
#include "tests/cage/gltf/draco.h"
#include "tests/cage/named_lines.h"
#include "tests/support/shared_assets.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <random>

namespace supple::cage {
namespace {

using namespace test;

using Bytes = std::vector<std::byte>;

/// A file with a bit of everything the reader looks at.
Bytes richFile() {
    GltfBuilder b = skinnedQuad();
    const int colors = b.addIntegers("VEC4", 5121, std::vector<uint32_t>(16, 200), true);
    const int sparseIndices = b.addIntegers("SCALAR", 5121, {1, 3});
    const int sparseValues = b.addFloats("VEC3", {1, 0, 0.5f, 0, 1, 0.5f});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2,"TEXCOORD_0":8,"COLOR_0":)" +
               std::to_string(colors) +
               R"(},"indices":3,"material":0,"extensions":{"FB_ngon_encoding":{}},"targets":[{"POSITION":0}]}]}])";
    b.more +=
        R"(,"extensionsUsed":["FB_ngon_encoding"],"materials":[{"name":"m","pbrMetallicRoughness":)"
        R"({"baseColorFactor":[1,1,1,1],"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":)"
        R"({"offset":[0,1],"rotation":1,"scale":[2,2],"texCoord":0}}},"metallicFactor":0.5,"roughnessFactor":1,)"
        R"("metallicRoughnessTexture":{"index":0}},"normalTexture":{"index":0,"scale":0.5},"occlusionTexture":)"
        R"({"index":1,"strength":0.5},"emissiveTexture":{"index":0},"emissiveFactor":[1,0,1],"extensions":)"
        R"({"KHR_materials_emissive_strength":{"emissiveStrength":2},"KHR_materials_unlit":{}}}],)"
        R"("textures":[{"source":0,"sampler":0},{"extensions":{"EXT_texture_webp":{"source":1}}}],)"
        R"("samplers":[{"wrapS":33071,"magFilter":9728,"minFilter":9987}],"images":[{"bufferView":0,"mimeType":"image/png"},)"
        R"({"uri":"data:image/png;base64,iVBORw0KGgo="}])";
    std::string json = b.json();
    const std::string first = R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3")";
    json.insert(json.find(first) + first.size(),
                R"(,"sparse":{"count":2,"indices":{"bufferView":)" + std::to_string(sparseIndices) +
                    R"(,"componentType":5121},"values":{"bufferView":)" + std::to_string(sparseValues) + "}}");
    return packGlb(json, b.binary());
}

/// Polygons, cage vertices, creases and holes of SUPPLE_mesh_cage, morph targets dense and sparse with a clip of
/// weights, and extras.
Bytes cageFile() {
    GltfBuilder b = skinnedQuad();
    const auto list = [&](const std::vector<uint32_t>& values) {
        return std::to_string(b.addIntegers("SCALAR", 5121, values));
    };
    const std::string deltas = std::to_string(b.addFloats("VEC3", {0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 2}));
    const int sparse = b.addFloats("VEC3", std::vector<float>(12, 1));
    const std::string sparseIndices = list({1, 3});
    const std::string sparseValues = std::to_string(b.addFloats("VEC3", {1, 0, 0.5f, 0, 1, 0.5f}));
    const std::string keys = std::to_string(b.addFloats("SCALAR", {0, 1, 0.5f, 0.25f, 1, 0}));
    const std::string sharpness = std::to_string(b.addFloats("SCALAR", {2.5f}));
    const std::string alpha = std::to_string(b.addFloats("SCALAR", {0.75f}));
    b.meshes = R"([{"weights":[0.5,0],"extras":{"targetNames":["a","b"],"creases":[[0,1,2]],"corners":[[3,10]]},)"
               R"("primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2,"TEXCOORD_0":8,"TEXCOORD_1":8},)"
               R"("indices":3,"targets":[{"POSITION":)" +
               deltas + R"(},{"POSITION":)" + std::to_string(sparse) + R"(}],"extensions":{"SUPPLE_mesh_cage":{)" +
               R"("faceVertexCounts":)" + list({4}) + R"(,"faceVertexIndices":)" + list({0, 1, 2, 3}) +
               R"(,"cageVertices":)" + list({5, 6, 7, 9}) + R"(,"creaseIndices":)" + list({5, 9}) +
               R"(,"creaseSharpnesses":)" + sharpness + R"(,"creaseSets":[{"name":"s","creases":)" + list({0}) +
               R"(}],"creaseScalarIndices":)" + list({6, 5}) + R"(,"creaseScalars":)" + alpha + R"(,"holeIndices":)" +
               list({0}) + R"(,"scheme":"catmullClark"}}}]}])";
    b.more += R"(,"extensionsUsed":["SUPPLE_mesh_cage"])";
    std::string json = b.json();
    const std::string clip = R"("animations":[)";
    json.insert(json.find(clip) + clip.size(),
                R"({"samplers":[{"input":5,"output":)" + keys +
                    R"(}],"channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}]},)");
    const std::string first =
        R"({"bufferView":)" + std::to_string(sparse) + R"(,"componentType":5126,"count":4,"type":"VEC3")";
    json.insert(json.find(first) + first.size(), R"(,"sparse":{"count":2,"indices":{"bufferView":)" + sparseIndices +
                                                     R"(,"componentType":5121},"values":{"bufferView":)" +
                                                     sparseValues + "}}");
    return packGlb(json, b.binary());
}

/// EXT_mesh_polygon and hidden edges on a primitive each, merged by EXT_mesh_manifold; quantized positions.
Bytes polygonFile() {
    GltfBuilder b;
    b.addIntegers("VEC3", 5123, {0, 0, 0, 9, 0, 0, 9, 9, 0, 0, 9, 0, 9, 0, 0, 18, 0, 0, 18, 9, 0, 9, 9, 0});
    b.addIntegers("SCALAR", 5121, {0, 1, 2, 0, 2, 3});
    b.addIntegers("SCALAR", 5121, {4, 5, 6, 4, 6, 7});
    const int all = b.addIntegers("SCALAR", 5121, {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7});
    const std::string mergeIndices = std::to_string(b.addIntegers("SCALAR", 5121, {6, 9, 11}));
    const std::string mergeValues = std::to_string(b.addIntegers("SCALAR", 5121, {1, 1, 2}));
    const std::string loops = std::to_string(b.addIntegers("SCALAR", 5121, {0, 1, 2, 3, 255}));
    const std::string zero = std::to_string(b.addIntegers("SCALAR", 5121, {0}));
    const std::string edges = std::to_string(b.addIntegers("SCALAR", 5121, {0x0A, 0x0A}));
    const std::string line = std::to_string(b.addIntegers("SCALAR", 5121, {4, 5, 255, 6, 7}));
    b.meshes =
        R"([{"extensions":{"EXT_mesh_manifold":{"manifoldPrimitive":{"indices":)" + std::to_string(all) +
        R"(,"mode":4,"attributes":{"POSITION":0}},"mergeIndices":)" + mergeIndices + R"(,"mergeValues":)" +
        mergeValues +
        R"(}},"primitives":[{"attributes":{"POSITION":0},"indices":1,"extensions":{"EXT_mesh_polygon":{"count":1,)"
        R"("indicesOffsets":)" +
        zero + R"(,"loopIndices":)" + loops + R"(,"loopIndicesOffsets":)" + zero +
        R"(}}},{"attributes":{"POSITION":0},"indices":2,"extensions":{"EXT_mesh_primitive_edge_visibility":)"
        R"({"visibility":)" +
        edges + R"(,"lineStrings":[{"indices":)" + line + "}]}}}]}]";
    b.more = R"(,"extensionsRequired":["KHR_mesh_quantization"])";
    std::string json = b.json();
    const std::string indices = R"("count":12,"type":"SCALAR")";
    json.insert(json.find(indices) + indices.size(), R"(,"sparse":{"count":3,"indices":{"bufferView":)" + mergeIndices +
                                                         R"(,"componentType":5121},"values":{"bufferView":)" +
                                                         mergeValues + "}}");
    return packGlb(json, b.binary());
}

/// Numbers of cage vertices in an attribute, all bufferViews compressed.
Bytes compressedFile() {
    GltfBuilder b = skinnedQuad();
    const std::string numbers = std::to_string(b.addFloats("SCALAR", {3, 2, 1, 0}));
    const std::string place = R"("POSITION":0,)";
    b.meshes.insert(b.meshes.find(place) + place.size(), R"("_CAGE_VERTEX":)" + numbers + ",");
    return compressed(b, "EXT_meshopt_compression", {.exponential = {7}, .quaternions = {6}});
}

/// The mesh compressed, its joints and weights as well.
Bytes dracoFile() {
    return dracoCompressed(skinnedQuad());
}

const std::vector<Bytes>& richFiles() {
    static const std::vector<Bytes> files = {richFile(), cageFile(), polygonFile(), compressedFile(), dracoFile()};
    return files;
}

/// Reads, and uses what was read the way the floors above will.
bool survives(const Bytes& bytes) {
    const Result<Character> result = readGltf(bytes, "t.glb", "", {.pairing = Pairing::always});
    if (!result.ok()) {
        EXPECT_TRUE(isLinesAbout("t.glb", result.error().message)) << result.error().message;
        return false;
    }
    const Character& c = *result;
    EXPECT_EQ(c.weights.starts.size(), c.cage.vertexCount() + size_t{1});
    for (const Influence& influence : c.weights.influences)
        EXPECT_LT(influence.joint, c.skin.joints.size());
    EXPECT_EQ(c.skin.joints.size(), c.skin.inverseBinds.size());
    EXPECT_EQ(c.skeleton.parentsFirst.size(), c.skeleton.nodes.size());
    for (const uint32_t v : c.cage.faceVertices)
        EXPECT_LT(v, c.cage.vertexCount());
    EXPECT_TRUE(c.cage.cornerUvs.empty() || c.cage.cornerUvs.size() == c.cage.cornerCount());
    EXPECT_TRUE(c.cage.cornerColors.empty() || c.cage.cornerColors.size() == c.cage.cornerCount());
    EXPECT_TRUE(c.cage.cornerUvs1.empty() || c.cage.cornerUvs1.size() == c.cage.cornerCount());
    for (const Material& material : c.materials) {
        for (const Texture* texture : texturesOf(material)) {
            EXPECT_TRUE(texture->image == kNone || texture->image < c.images.size());
            EXPECT_TRUE(texture->alternateImage == kNone || texture->alternateImage < c.images.size());
            EXPECT_LE(texture->uvSet, 1u);
        }
    }
    for (const Crease& crease : c.cage.creases) {
        EXPECT_LT(std::max(crease.a, crease.b), c.cage.vertexCount());
        EXPECT_NE(crease.a, crease.b);
        EXPECT_GE(crease.sharpness, 0.0f);
    }
    for (const SharpVertex& sharp : c.cage.sharpVertices) {
        EXPECT_LT(sharp.vertex, c.cage.vertexCount());
    }
    for (size_t i = 0; i < c.cage.holes.size(); ++i) {
        EXPECT_LT(c.cage.holes[i], c.cage.faceCount());
        EXPECT_TRUE(i == 0 || c.cage.holes[i] > c.cage.holes[i - 1]);
    }
    EXPECT_EQ(c.morphs.weights.size(), c.morphs.targets.size());
    for (const MorphTarget& target : c.morphs.targets) {
        EXPECT_EQ(target.vertices.size(), target.deltas.size());
        for (size_t i = 0; i < target.vertices.size(); ++i) {
            EXPECT_LT(target.vertices[i], c.cage.vertexCount());
            EXPECT_TRUE(i == 0 || target.vertices[i] > target.vertices[i - 1]);
        }
    }
    for (const Clip& clip : c.clips) {
        for (const Channel& channel : clip.channels) {
            const size_t width = channel.path == ChannelPath::weights    ? c.morphs.targets.size()
                                 : channel.path == ChannelPath::rotation ? 4
                                                                         : 3;
            EXPECT_EQ(channel.values.size(),
                      channel.times.size() * width * (channel.interpolation == Interpolation::cubicSpline ? 3 : 1));
        }
    }
    (void)buildTopology(c.cage).ok();
    return true;
}

TEST(GltfRobustness, TheFilesThemselvesAreRight) {
    for (const Bytes& file : richFiles()) {
        EXPECT_TRUE(survives(file));
    }
    const Result<Character> c = readGltf(richFile(), "t.glb", "");
    ASSERT_TRUE(c.ok());
    EXPECT_EQ(c->cage.positions[3], glm::vec3(0, 1, 0.5f));
    EXPECT_EQ(c->materials[0].baseColorTexture.image, 0u);

    const Result<Character> cage = readGltf(cageFile(), "t.glb", "");
    ASSERT_TRUE(cage.ok()) << cage.error().message;
    EXPECT_EQ(cage->parts[0].polygonSource, PolygonSource::cageExtension);
    EXPECT_EQ(cage->cage.creases.size(), 1u);
    EXPECT_EQ(cage->cage.sharpVertices.size(), 1u);
    EXPECT_EQ(cage->cage.holes.size(), 1u);
    EXPECT_EQ(cage->morphs.targets[1].deltas[1], glm::vec3(1, 0, 0.5f));
    EXPECT_EQ(cage->clips[0].channels[0].path, ChannelPath::weights);

    const Result<Character> polygons = readGltf(polygonFile(), "t.glb", "");
    ASSERT_TRUE(polygons.ok()) << polygons.error().message;
    EXPECT_EQ(polygons->parts[0].polygonSource, PolygonSource::meshPolygon);
    EXPECT_EQ(polygons->parts[0].weldSource, WeldSource::meshManifold);
    EXPECT_EQ(polygons->cage.vertexCount(), 6u);
    EXPECT_EQ(polygons->cage.faceCount(), 2u);

    const Result<Character> packed = readGltf(compressedFile(), "t.glb", "");
    ASSERT_TRUE(packed.ok()) << packed.error().message;
    EXPECT_EQ(packed->parts[0].weldSource, WeldSource::vertexAttribute);
    EXPECT_EQ(packed->clips[0].channels.size(), 2u);
}

TEST(GltfRobustness, TruncatedAnywhere) {
    for (const Bytes& whole : richFiles()) {
        for (size_t length = 0; length < whole.size(); ++length) {
            const Bytes part(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(length));
            EXPECT_FALSE(survives(part)) << length;
            // And with a header that does not give it away.
            Bytes honest = part;
            if (length < 12) {
                continue;
            }
            for (size_t i = 0; i < 4; ++i) {
                honest[8 + i] = static_cast<std::byte>((length >> (8 * i)) & 0xFF);
            }
            survives(honest);
        }
    }
}

TEST(GltfRobustness, RandomBytes) {
    std::mt19937 random(20240607);
    for (const Bytes& whole : richFiles()) {
        const size_t binary = 20 + (static_cast<size_t>(whole[12]) | static_cast<size_t>(whole[13]) << 8) + 8;
        int read = 0;
        for (int round = 0; round < 4000; ++round) {
            Bytes damaged = whole;
            const int changes = 1 + static_cast<int>(random() % 4);
            // Everywhere, or in the data alone: damage to the JSON hides what the data's would do.
            const size_t begin = round % 2 == 0 ? 0 : binary;
            for (int k = 0; k < changes; ++k) {
                damaged[begin + random() % (damaged.size() - begin)] = static_cast<std::byte>(random() & 0xFF);
            }
            read += survives(damaged) ? 1 : 0;
        }
        EXPECT_GT(read, 0) << "some damage does no harm";
    }
}

TEST(GltfRobustness, RandomDigits) {
    // Byte noise breaks the JSON; this keeps it whole and the numbers wrong.
    std::mt19937 random(99);
    for (const Bytes& whole : richFiles()) {
        std::vector<size_t> digits;
        const size_t jsonEnd = 20 + (static_cast<size_t>(whole[12]) | static_cast<size_t>(whole[13]) << 8);
        for (size_t i = 20; i < jsonEnd; ++i) {
            if (whole[i] >= std::byte{'0'} && whole[i] <= std::byte{'9'}) {
                digits.push_back(i);
            }
        }
        int read = 0;
        for (int round = 0; round < 3000; ++round) {
            Bytes damaged = whole;
            const int changes = 1 + static_cast<int>(random() % 3);
            for (int k = 0; k < changes; ++k) {
                damaged[digits[random() % digits.size()]] = static_cast<std::byte>('0' + random() % 10);
            }
            read += survives(damaged) ? 1 : 0;
        }
        EXPECT_GT(read, 0);
    }
}

TEST(GltfRobustness, RandomTokens) {
    // Whole tokens for others: wrong types, huge, negative and fractional numbers, nulls.
    const std::vector<std::string> tokens = {"-1",    "0.5",  "4294967295", "18446744073709551615",
                                             "1e300", "null", "true",       "\"\"",
                                             "[]",    "{}",   "[[0]]",      "2147483648"};
    for (const Bytes& whole : richFiles()) {
        const size_t jsonEnd = 20 + (static_cast<size_t>(whole[12]) | static_cast<size_t>(whole[13]) << 8);
        const std::string json(reinterpret_cast<const char*>(whole.data()) + 20, jsonEnd - 20);
        const Bytes binary(whole.begin() + static_cast<ptrdiff_t>(jsonEnd) + 8, whole.end());
        std::vector<std::pair<size_t, size_t>> values; // begin, end of every scalar after ':' '[' ','
        for (size_t i = 1; i < json.size(); ++i) {
            if (json[i - 1] != ':' && json[i - 1] != '[' && json[i - 1] != ',') {
                continue;
            }
            size_t end = i;
            if (json[i] == '"') {
                end = json.find('"', i + 1) + 1;
            } else {
                while (end < json.size() && (std::isalnum(static_cast<unsigned char>(json[end])) != 0 ||
                                             json[end] == '.' || json[end] == '-')) {
                    ++end;
                }
            }
            if (end > i && json[end] != ':') {
                values.emplace_back(i, end);
            }
        }
        for (const auto& [begin, end] : values) {
            for (const std::string& token : tokens) {
                survives(packGlb(json.substr(0, begin) + token + json.substr(end), binary));
            }
        }
    }
}

TEST(GltfRobustness, SharedCharactersDamaged) {
    std::mt19937 random(5);
    for (const std::string& path : supple::test::sharedAssets(
             {"characters/spot_uvsplit.glb", "characters/shark.glb", "khronos/RiggedSimple.glb"})) {
        std::ifstream stream(path, std::ios::binary);
        const std::vector<char> text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
        ASSERT_FALSE(text.empty()) << path;
        Bytes whole(text.size());
        std::memcpy(whole.data(), text.data(), text.size());
        for (int round = 0; round < 60; ++round)
            survives(Bytes(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(random() % whole.size())));
        for (int round = 0; round < 300; ++round) {
            Bytes damaged = whole;
            for (int k = 0; k < 3; ++k)
                damaged[random() % damaged.size()] = static_cast<std::byte>(random() & 0xFF);
            survives(damaged);
        }
    }
}

} // namespace
} // namespace supple::cage
