// Trims of a glTF file: what is read, which source wins, and one line for everything that can be wrong.
#include "cage/trim.h"
#include "tests/cage/gltf/reading.h"

#include <gtest/gtest.h>

namespace supple::cage {
namespace {

using namespace test;

/// Signature and IHDR of a PNG: all that is read of it here.
std::string pngUri(uint32_t width, uint32_t height) {
    std::vector<std::byte> bytes;
    const auto put = [&](std::initializer_list<unsigned> values) {
        for (const unsigned value : values) {
            bytes.push_back(static_cast<std::byte>(value));
        }
    };
    put({0x89, 'P', 'N', 'G', 0x0D, 0x0A, 0x1A, 0x0A, 0, 0, 0, 13, 'I', 'H', 'D', 'R'});
    for (const uint32_t size : {width, height}) {
        put({size >> 24 & 0xFF, size >> 16 & 0xFF, size >> 8 & 0xFF, size & 0xFF});
    }
    return R"({"uri":"data:image/png;base64,)" + base64(bytes) + "\"}";
}

/// A comment, then the frame header of a JPEG of 32 x 16 pixels.
std::string jpegUri() {
    std::vector<std::byte> bytes;
    for (const unsigned value :
         {0xFF, 0xD8, 0xFF, 0xFE, 0, 4, 1, 2, 0xFF, 0xC2, 0, 11, 8, 0, 16, 0, 32, 1, 1, 0x11, 0}) {
        bytes.push_back(static_cast<std::byte>(value));
    }
    return R"({"uri":"data:image/jpeg;base64,)" + base64(bytes) + "\"}";
}

/// The quad with a material whose extras.trim is `trim`; texture 0 is a PNG of 64 x 16, the further ones are for
/// errors: 1 a text, 2 missing, 3 without an image, 4 a strip of tiles that are not square, 5 a JPEG, 6 cut off.
GltfBuilder trimmed(const std::string& trim, const std::string& attributes = "", const std::string& material = "") {
    GltfBuilder b = skinnedQuad();
    b.meshes = replaced(b.meshes, R"("mode":4)", R"("material":0)");
    b.meshes = replaced(b.meshes, R"("TEXCOORD_0":8)", R"("TEXCOORD_0":8)" + attributes);
    b.more += R"(,"materials":[{"extras":{"maker":"somebody","trim":)" + trim + "}" + material + R"(}],)" +
              R"("textures":[{"source":0,"sampler":0},{"source":1},{"source":2},{},{"source":3},{"source":4},)" +
              R"({"source":5}],"samplers":[{"wrapS":33071,"wrapT":33648}],"images":[)" + pngUri(64, 16) +
              R"(,{"uri":"data:text/plain;base64,R0lGODlhAQAB"},{"uri":"gone.png"},)" + pngUri(60, 16) + "," +
              jpegUri() + R"(,{"uri":"data:image/png;base64,iVBORw0KGgo="}])";
    return b;
}

/// With tiles for the quad's four vertices.
GltfBuilder tiled(const std::string& trim, const std::vector<float>& tiles) {
    GltfBuilder b = trimmed(trim, R"(,"_TRIM_TILE":9)");
    EXPECT_EQ(b.addFloats("SCALAR", tiles), 9);
    return b;
}

TEST(GltfTrim, IsReadFromExtras) {
    const Character c =
        readWell(trimmed(R"({"texture":{"index":0,"texCoord":1},"channel":"g","cutoff":0.25})", R"(,"TEXCOORD_1":8)"));
    ASSERT_EQ(c.materials.size(), 1u);
    ASSERT_TRUE(c.materials[0].trim);
    const Texture sampled{.image = 0, .uvSet = 1, .wrapU = Wrap::clampToEdge, .wrapV = Wrap::mirroredRepeat};
    EXPECT_TRUE(*c.materials[0].trim == (Trim{.texture = sampled, .channel = 1, .cutoff = 0.25f}));
    EXPECT_TRUE(c.cage.faceTrimTiles.empty());

    const Character plain = readWell(trimmed(R"({"texture":{"index":5}})"));
    EXPECT_TRUE(*plain.materials[0].trim == (Trim{.texture = {.image = 4}}));
}

TEST(GltfTrim, MayBeTransformed) {
    const std::string transform =
        R"("extensions":{"KHR_texture_transform":{"offset":[0.5,0],"rotation":1.5,"scale":[2,3],"texCoord":1}})";
    const Character c = readWell(trimmed(R"({"texture":{"index":5,)" + transform + R"(}})", R"(,"TEXCOORD_1":8)"));
    const Texture placed{.image = 4, .uvSet = 1, .offset = {0.5f, 0.0f}, .rotation = 1.5f, .scale = {2.0f, 3.0f}};
    EXPECT_TRUE(c.materials[0].trim->texture == placed);
    EXPECT_EQ(messageOf(tiled(R"({"domain":"face","texture":{"index":0,)" + transform + R"(}})", {0, 0, 0, 0})),
              "t.glb: material 0 extras.trim texture: KHR_texture_transform on tiles of faces");
}

TEST(GltfTrim, WinsOverTheMask) {
    const std::string mask = R"(,"alphaMode":"MASK","alphaCutoff":0.75,)"
                             R"("pbrMetallicRoughness":{"baseColorTexture":{"index":5,"texCoord":1}})";
    const Material both = readWell(trimmed(R"({"texture":{"index":0},"channel":"a"})", "", mask)).materials[0];
    EXPECT_EQ(both.alphaMode, AlphaMode::mask);
    ASSERT_TRUE(trimOf(both));
    EXPECT_EQ(trimOf(both)->texture.image, 0u);
    EXPECT_EQ(trimOf(both)->cutoff, 0.5f);

    const Material alone = readWell(trimmed("null", R"(,"TEXCOORD_1":8)", mask)).materials[0];
    EXPECT_FALSE(alone.trim);
    ASSERT_TRUE(trimOf(alone));
    EXPECT_TRUE(*trimOf(alone) == (Trim{.texture = {.image = 4, .uvSet = 1}, .channel = 3, .cutoff = 0.75f}));

    Material opaque = alone;
    opaque.alphaMode = AlphaMode::opaque;
    EXPECT_FALSE(trimOf(opaque));
    Material untextured = alone;
    untextured.baseColorTexture = {};
    EXPECT_FALSE(trimOf(untextured)) << "nothing to look up: the alpha is one number";
}

TEST(GltfTrim, TilesOfFaces) {
    const std::string strip = R"({"texture":{"index":0},"domain":"face"})";
    const Character c = readWell(tiled(strip, {3, 3, 3, 3}));
    EXPECT_EQ(c.materials[0].trim->domain, TrimDomain::face);
    EXPECT_EQ(c.materials[0].trim->tiles, 4u) << "64 x 16 pixels";
    EXPECT_EQ(c.cage.faceTrimTiles, (std::vector<uint32_t>{3, 3}));
    EXPECT_EQ(readWell(tiled(strip, {-1, -1, -1, -1})).cage.faceTrimTiles, (std::vector<uint32_t>{kNone, kNone}));
    EXPECT_EQ(readWell(tiled(R"({"texture":{"index":4},"domain":"face","tiles":3})", {2, 2, 2, 2})).cage.faceTrimTiles,
              (std::vector<uint32_t>{2, 2}));
    EXPECT_EQ(readWell(tiled(R"({"texture":{"index":5},"domain":"face"})", {1, 1, 1, 1})).materials[0].trim->tiles, 2u)
        << "a JPEG of 32 x 16 pixels";

    GltfBuilder integers = trimmed(strip, R"(,"_TRIM_TILE":9)");
    integers.addIntegers("SCALAR", 5120, {0xFF, 0xFF, 0xFF, 0xFF});
    EXPECT_EQ(readWell(integers).cage.faceTrimTiles, (std::vector<uint32_t>{kNone, kNone})) << "signed bytes";
}

TEST(GltfTrim, WhatOtherToolsWriteIsLeftAlone) {
    const Character c = readWell(trimmed("true"));
    EXPECT_FALSE(c.materials[0].trim);
    EXPECT_EQ(c.warnings.back(), "material 0 extras.trim: not an object; left out");
    GltfBuilder list = skinnedQuad();
    list.more += R"(,"materials":[{"extras":["trim"]},{"extras":7}])";
    EXPECT_FALSE(readWell(list).materials[0].trim);
}

TEST(GltfTrim, NamedErrors) {
    const auto error = [](const std::string& trim) { return messageOf(trimmed(trim)); };
    EXPECT_EQ(error("{}"), "t.glb: material 0 extras.trim: no texture");
    EXPECT_EQ(error(R"({"texture":3})"), "t.glb: material 0 extras.trim texture: not an object");
    EXPECT_EQ(error(R"({"texture":{}})"), "t.glb: material 0 extras.trim texture: index is missing");
    EXPECT_EQ(error(R"({"texture":{"index":7}})"),
              "t.glb: material 0 extras.trim texture index: texture 7 is out of range: the file has 7");
    EXPECT_EQ(error(R"({"texture":{"index":1}})"),
              "t.glb: material 0 extras.trim texture: image 1 is neither PNG nor JPEG");
    EXPECT_EQ(error(R"({"texture":{"index":2}})"), "t.glb: material 0 extras.trim texture: image 2 is missing");
    EXPECT_EQ(error(R"({"texture":{"index":3}})"),
              "t.glb: material 0 extras.trim texture: texture 3 has no image in a core format");
    EXPECT_EQ(error(R"({"texture":{"index":0,"texCoord":1}})"),
              "t.glb: mesh 0 primitive 0: no TEXCOORD_1, on which the trim of material 0 lies");
    EXPECT_EQ(error(R"({"texture":{"index":0,"texCoord":2}})"),
              "t.glb: material 0 extras.trim texture: texCoord 2: only TEXCOORD_0 and TEXCOORD_1 are read");
    EXPECT_EQ(error(R"({"texture":{"index":0},"channel":"x"})"),
              "t.glb: material 0 extras.trim channel: \"x\" is none of r, g, b, a");
    EXPECT_EQ(error(R"({"texture":{"index":0},"domain":"vertex"})"),
              "t.glb: material 0 extras.trim domain: \"vertex\" is neither uv nor face");
    for (const char* cutoff : {"1.5", "-0.1", "\"half\""}) {
        EXPECT_EQ(error(R"({"texture":{"index":0},"cutoff":)" + std::string(cutoff) + "}"),
                  "t.glb: material 0 extras.trim cutoff: not a number from 0 to 1");
    }
}

TEST(GltfTrim, NamedErrorsOfTiles) {
    const std::string strip = R"({"texture":{"index":0},"domain":"face"})";
    EXPECT_EQ(messageOf(trimmed(strip)),
              "t.glb: mesh 0 primitive 0: no _TRIM_TILE, which names the tiles of the trim of "
              "material 0");
    const auto error = [&](const std::vector<float>& tiles) { return messageOf(tiled(strip, tiles)); };
    EXPECT_EQ(error({0, 0, 4, 0}), "t.glb: mesh 0 primitive 0 _TRIM_TILE[2]: tile 4 is out of range: the trim of "
                                   "material 0 has 4 tiles");
    EXPECT_EQ(error({0, -2, 0, 0}), "t.glb: mesh 0 primitive 0 _TRIM_TILE[1]: neither the number of a tile nor -1");
    EXPECT_EQ(error({0, 0.5f, 0, 0}), "t.glb: mesh 0 primitive 0 _TRIM_TILE[1]: neither the number of a tile nor -1");
    EXPECT_EQ(error({0, 0, 0, -1}), "t.glb: mesh 0 primitive 0 _TRIM_TILE: the vertices of face 1 name tiles 0 and -1");
    EXPECT_EQ(error({0, 0, 0}), "t.glb: mesh 0 primitive 0 _TRIM_TILE: 3 elements for 4 vertices");
    EXPECT_EQ(
        messageOf(tiled(R"({"texture":{"index":4},"domain":"face"})", {0, 0, 0, 0})),
        "t.glb: material 0 extras.trim texture: image 3 is 60 x 16 pixels, no strip of square tiles, and tiles does "
        "not say how many");
    EXPECT_EQ(messageOf(tiled(R"({"texture":{"index":6},"domain":"face"})", {0, 0, 0, 0})),
              "t.glb: material 0 extras.trim texture: image 5 has no size: cut off in its header");
    EXPECT_EQ(messageOf(tiled(R"({"texture":{"index":0},"domain":"face","tiles":1025})", {0, 0, 0, 0})),
              "t.glb: material 0 extras.trim tiles: 1025, more than 1024");
}

/// No reading shows what a trim would cut off.
TEST(GltfTrim, WrongTilesAreRefusedByALenientReading) {
    const std::string strip = R"({"texture":{"index":0},"domain":"face"})";
    EXPECT_EQ(saidOf(trimmed(strip).glb()), "refused: " + messageOf(trimmed(strip)));
    for (const std::vector<float>& tiles : {std::vector<float>{0, 0, 4, 0}, {0, 0, 0, -1}, {0, 0, 0}}) {
        EXPECT_EQ(saidOf(tiled(strip, tiles).glb()), "refused: " + messageOf(tiled(strip, tiles)));
    }
}

TEST(GltfTrim, PairsOfTrianglesHaveOneTile) {
    GltfOptions pairs;
    pairs.pairing = Pairing::always;
    const std::string strip = R"({"texture":{"index":0},"domain":"face"})";
    EXPECT_EQ(readWell(tiled(strip, {2, 2, 2, 2}), pairs).cage.faceTrimTiles, (std::vector<uint32_t>{2}));
    // Two triangles apart, with a tile each: corners on the common edge do not agree.
    GltfBuilder b = tiled(strip, {0, 0, 0, 1, 1, 1});
    const int positions = b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":)" + std::to_string(positions) +
               R"(,"_TRIM_TILE":9},"material":0}]}])";
    b.nodes = R"([{"mesh":0},{},{}])";
    EXPECT_EQ(readWell(b, pairs).cage.faceTrimTiles, (std::vector<uint32_t>{0, 1}));
}

} // namespace
} // namespace supple::cage
