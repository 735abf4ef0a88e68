// Damaged files are refused or read, never more. Worth most under the address and undefined behavior sanitizers.
#include "cage/gltf_reader.h"
#include "cage/topology.h"
#include "tests/cage/gltf_builder.h"

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
    b.more += R"(,"extensionsUsed":["FB_ngon_encoding"],"materials":[{"name":"m","pbrMetallicRoughness":)"
              R"({"baseColorFactor":[1,1,1,1],"baseColorTexture":{"index":0}}}],"textures":[{"source":0,"sampler":0}],)"
              R"("samplers":[{"wrapS":33071}],"images":[{"bufferView":0,"mimeType":"image/png"},)"
              R"({"uri":"data:image/png;base64,iVBORw0KGgo="}])";
    std::string json = b.json();
    const std::string first = R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3")";
    json.insert(json.find(first) + first.size(),
                R"(,"sparse":{"count":2,"indices":{"bufferView":)" + std::to_string(sparseIndices) +
                    R"(,"componentType":5121},"values":{"bufferView":)" + std::to_string(sparseValues) + "}}");
    return packGlb(json, b.binary());
}

/// Reads, and uses what was read the way the floors above will.
bool survives(const Bytes& bytes) {
    const Result<Character> result = readGltf(bytes, "t.glb", "", {.pairQuads = true});
    if (!result.ok()) {
        EXPECT_EQ(result.error().message.rfind("t.glb: ", 0), 0u) << result.error().message;
        EXPECT_EQ(result.error().message.find('\n'), std::string::npos) << result.error().message;
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
    for (const Material& material : c.materials)
        EXPECT_TRUE(material.baseColorImage == kNone || material.baseColorImage < c.images.size());
    (void)buildTopology(c.cage).ok();
    return true;
}

TEST(GltfRobustness, TheFileItselfIsRight) {
    EXPECT_TRUE(survives(richFile()));
    const Result<Character> c = readGltf(richFile(), "t.glb", "");
    ASSERT_TRUE(c.ok());
    EXPECT_EQ(c->cage.positions[3], glm::vec3(0, 1, 0.5f));
    EXPECT_EQ(c->materials[0].baseColorImage, 0u);
}

TEST(GltfRobustness, TruncatedAnywhere) {
    const Bytes whole = richFile();
    for (size_t length = 0; length < whole.size(); ++length) {
        const Bytes part(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(length));
        EXPECT_FALSE(survives(part)) << length;
        // And with a header that does not give it away.
        Bytes honest = part;
        if (length < 12)
            continue;
        for (size_t i = 0; i < 4; ++i)
            honest[8 + i] = static_cast<std::byte>((length >> (8 * i)) & 0xFF);
        survives(honest);
    }
}

TEST(GltfRobustness, RandomBytes) {
    const Bytes whole = richFile();
    std::mt19937 random(20240607);
    int read = 0;
    for (int round = 0; round < 6000; ++round) {
        Bytes damaged = whole;
        const int changes = 1 + static_cast<int>(random() % 4);
        for (int k = 0; k < changes; ++k)
            damaged[random() % damaged.size()] = static_cast<std::byte>(random() & 0xFF);
        read += survives(damaged) ? 1 : 0;
    }
    EXPECT_GT(read, 0) << "some damage does no harm";
}

TEST(GltfRobustness, RandomDigits) {
    // Byte noise breaks the JSON; this keeps it whole and the numbers wrong.
    const Bytes whole = richFile();
    std::vector<size_t> digits;
    const size_t jsonEnd = 20 + (static_cast<size_t>(whole[12]) | static_cast<size_t>(whole[13]) << 8);
    for (size_t i = 20; i < jsonEnd; ++i)
        if (whole[i] >= std::byte{'0'} && whole[i] <= std::byte{'9'})
            digits.push_back(i);
    std::mt19937 random(99);
    int read = 0;
    for (int round = 0; round < 6000; ++round) {
        Bytes damaged = whole;
        const int changes = 1 + static_cast<int>(random() % 3);
        for (int k = 0; k < changes; ++k)
            damaged[digits[random() % digits.size()]] = static_cast<std::byte>('0' + random() % 10);
        read += survives(damaged) ? 1 : 0;
    }
    EXPECT_GT(read, 0);
}

TEST(GltfRobustness, RandomTokens) {
    // Whole tokens for others: wrong types, huge, negative and fractional numbers, nulls.
    const Bytes whole = richFile();
    const size_t jsonEnd = 20 + (static_cast<size_t>(whole[12]) | static_cast<size_t>(whole[13]) << 8);
    const std::string json(reinterpret_cast<const char*>(whole.data()) + 20, jsonEnd - 20);
    const Bytes binary(whole.begin() + static_cast<ptrdiff_t>(jsonEnd) + 8, whole.end());
    const std::vector<std::string> tokens = {"-1",    "0.5",  "4294967295", "18446744073709551615",
                                             "1e300", "null", "true",       "\"\"",
                                             "[]",    "{}",   "[[0]]",      "2147483648"};
    std::vector<std::pair<size_t, size_t>> values; // begin, end of every scalar after ':' '[' ','
    for (size_t i = 1; i < json.size(); ++i) {
        if (json[i - 1] != ':' && json[i - 1] != '[' && json[i - 1] != ',')
            continue;
        size_t end = i;
        if (json[i] == '"')
            end = json.find('"', i + 1) + 1;
        else
            while (end < json.size() &&
                   (std::isalnum(static_cast<unsigned char>(json[end])) != 0 || json[end] == '.' || json[end] == '-'))
                ++end;
        if (end > i && json[end] != ':')
            values.emplace_back(i, end);
    }
    for (const auto& [begin, end] : values)
        for (const std::string& token : tokens)
            survives(packGlb(json.substr(0, begin) + token + json.substr(end), binary));
}

TEST(GltfRobustness, SharedCharactersDamaged) {
    const std::string folder = std::string(SUPPLE_SHARED_DIR) + "/assets/";
    size_t leftOut = 0;
    std::mt19937 random(5);
    for (const char* name : {"characters/spot_uvsplit.glb", "characters/shark.glb", "khronos/RiggedSimple.glb"}) {
        std::ifstream stream(folder + name, std::ios::binary);
        const std::vector<char> text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
        if (text.empty()) {
            ++leftOut;
            continue;
        }
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
    if (leftOut > 0)
        std::printf("%zu shared-asset cases left out: ../shared not present\n", leftOut);
}

} // namespace
} // namespace supple::cage
