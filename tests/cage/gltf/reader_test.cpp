// What a glTF file reads as: odd JSON, which of its meshes, vertices and corners, creases in extras.
#include "cage/topology.h"
#include "tests/cage/gltf/reading.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

namespace supple::cage {
namespace {

using namespace test;

TEST(GltfReader, SkinnedQuad) {
    for (const auto& bytes : {skinnedQuad().glb(), skinnedQuad().embedded()}) {
        const Character c = readWell(bytes);
        EXPECT_EQ(c.name, "t.glb");
        EXPECT_EQ(c.warnings, Strings());
        EXPECT_EQ(c.parts[0].polygonSource, PolygonSource::triangles);
        EXPECT_EQ(c.cage.vertexCount(), 4u);
        ASSERT_EQ(c.cage.faceCount(), 2u);
        EXPECT_EQ(face(c.cage, 0), (std::vector<uint32_t>{0, 1, 2}));
        EXPECT_EQ(face(c.cage, 1), (std::vector<uint32_t>{0, 2, 3}));
        EXPECT_EQ(c.cage.sourceVertices, (std::vector<uint32_t>{0, 1, 2, 3}));
        EXPECT_EQ(c.cage.faceMaterials, (std::vector<uint32_t>{kNone, kNone}));
        ASSERT_EQ(c.cage.cornerUvs.size(), 6u);
        EXPECT_EQ(c.cage.cornerUvs[4], glm::vec2(1, 1));
        EXPECT_TRUE(c.cage.cornerColors.empty());
        EXPECT_EQ(c.sourceVertexCount, 4u);
        EXPECT_EQ(c.seamVertexCount, 0u);

        ASSERT_EQ(c.skeleton.nodes.size(), 3u);
        EXPECT_EQ(c.skeleton.nodes[2].parent, 1u);
        EXPECT_EQ(c.skeleton.nodes[2].name, "tip");
        EXPECT_EQ(c.skeleton.parentsFirst, (std::vector<uint32_t>{0, 1, 2}));
        EXPECT_EQ(c.skin.joints, (std::vector<uint32_t>{1, 2}));
        EXPECT_EQ(c.skin.inverseBinds[1][3], glm::vec4(-1, 0, 0, 1));

        EXPECT_EQ(c.weights.starts, (std::vector<uint32_t>{0, 1, 3, 5, 6}));
        EXPECT_EQ(c.weights.influences[4].joint, 1u);
        EXPECT_EQ(c.weights.influences[4].weight, 0.75f);

        ASSERT_EQ(c.clips.size(), 1u);
        EXPECT_EQ(c.clips[0].name, "clip_0");
        EXPECT_EQ(c.clips[0].duration, 2.0);
        ASSERT_EQ(c.clips[0].channels.size(), 2u);
        EXPECT_EQ(c.clips[0].channels[0].path, ChannelPath::rotation);
        EXPECT_EQ(c.clips[0].channels[0].interpolation, Interpolation::linear);
        EXPECT_EQ(c.clips[0].channels[1].values, (std::vector<float>{0, 0, 0, 1, 2, 3, 0, 0, 0}));
    }
}

TEST(GltfReader, PolygonSourceNames) {
    EXPECT_STREQ(polygonSourceName(PolygonSource::triangles), "triangles");
    EXPECT_STREQ(polygonSourceName(PolygonSource::ngonEncoding), "FB_ngon_encoding");
    EXPECT_STREQ(polygonSourceName(PolygonSource::pairedTriangles), "paired triangles");
    EXPECT_STREQ(polygonSourceName(PolygonSource::arrays), "arrays");
}

TEST(GltfReader, JsonOddities) {
    const GltfBuilder b = skinnedQuad();
    // A byte order mark, leading space, zeros for padding, nulls for absent members.
    EXPECT_TRUE(readGltf(toBytes("\xEF\xBB\xBF \n" + b.json("data:;base64," + base64(b.binary()))), "t", "").ok());
    EXPECT_TRUE(readGltf(packGlb(b.json() + std::string(3, '\0') + std::string(1, '\0'), b.binary()), "t", "").ok());
    EXPECT_TRUE(readGltf(packGlb(replaced(b.json(), R"("name":"root")", R"("skin":null,"rotation":null,"name":"root")"),
                                 b.binary()),
                         "t", "")
                    .ok());
    // Base64 in lines, and a media type nobody registered.
    std::string lines = base64(b.binary());
    for (size_t i = 76; i < lines.size(); i += 80)
        lines.insert(i, " \\n");
    EXPECT_TRUE(readGltf(toBytes(b.json("data:model/vnd.acme;x=y;base64," + lines)), "t", "").ok());
    // Extensions and extras that mean nothing here, however large.
    EXPECT_TRUE(readGltf(packGlb(replaced(b.json(), R"("name":"root")",
                                          R"("name":"root","extras":[[1],{"extras":2}],"extensions":{"A":{"b":[3]}})"),
                                 b.binary()),
                         "t", "")
                    .ok());
}

TEST(GltfReader, NameAndControlCharactersStayOnOneLine) {
    GltfBuilder b = skinnedQuad();
    b.more += R"(,"images":[{"uri":"a\nb.png"}])";
    const Result<Character> result = readGltf(b.glb(), "two\nlines", "", kKeepTriangles);
    ASSERT_TRUE(result.ok());
    ASSERT_EQ(result->warnings.size(), 1u);
    EXPECT_EQ(result->warnings[0], "image 0 uri: \"a?b.png\": path contains a control character; left out");
}

// ---- which mesh -----------------------------------------------------------------------------------------------------

TEST(GltfReader, UnskinnedMeshHangsOnItsNode) {
    GltfBuilder b = skinnedQuad();
    b.nodes = R"([{},{"mesh":0,"scale":[-2,2,2]},{}])";
    const Character c = readWell(b.glb());
    EXPECT_EQ(c.skin.joints, std::vector<uint32_t>{1});
    // The node mirrors, so the faces are turned, and the cage is taken to where they are seen from outside.
    EXPECT_EQ(c.skin.inverseBinds[0][0], glm::vec4(-0.5f, 0, 0, 0));
    EXPECT_EQ(c.cage.positions[1], glm::vec3(-2, 0, 0));
    EXPECT_EQ(face(c.cage, 0), (std::vector<uint32_t>{0, 2, 1}));
    EXPECT_EQ(c.weights.starts, (std::vector<uint32_t>{0, 1, 2, 3, 4}));
    for (const Influence& influence : c.weights.influences) {
        EXPECT_EQ(influence.joint, 0u);
        EXPECT_EQ(influence.weight, 1.0f);
    }
}

TEST(GltfReader, PointsAndLinesAreLeftOut) {
    GltfBuilder b = skinnedQuad();
    const std::string triangles = R"({"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3})";
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"mode":1},)" + triangles +
               R"(,{"attributes":{"POSITION":0},"mode":0}]}])";
    const Character c = readWell(b.glb());
    EXPECT_EQ(c.cage.faceCount(), 2u);
    EXPECT_EQ(c.warnings, (Strings{"mesh 0 primitive 0: LINES instead of TRIANGLES; left out",
                                   "mesh 0 primitive 2: POINTS instead of TRIANGLES; left out"}));
}

TEST(GltfReader, PrimitivesOverTheSameAccessorsShareVertices) {
    GltfBuilder b = skinnedQuad();
    const int first = b.addIntegers("SCALAR", 5121, {0, 1, 2});
    const int second = b.addIntegers("SCALAR", 5125, {0, 2, 3});
    const auto primitive = [](int indices, int material) {
        return R"({"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":)" + std::to_string(indices) +
               R"(,"material":)" + std::to_string(material) + "}";
    };
    b.meshes = R"([{"primitives":[)" + primitive(first, 1) + "," + primitive(second, 0) + "]}]";
    b.more += R"(,"materials":[{"name":"a"},{"name":"b","doubleSided":true}])";
    const Character c = readWell(b.glb());
    EXPECT_EQ(c.cage.vertexCount(), 4u);
    EXPECT_EQ(c.sourceVertexCount, 4u);
    EXPECT_EQ(c.cage.faceMaterials, (std::vector<uint32_t>{1, 0}));
    EXPECT_TRUE(buildTopology(c.cage).ok());
}

TEST(GltfReader, PrimitivesAreWeldedToEachOther) {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0});
    b.addFloats("VEC3", {1, 1, 0, 0, 1, 0, -0.0f, 0, 0}); // -0 is 0
    b.addFloats("VEC2", {5, 5, 6, 6, 7, 7});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0}},{"attributes":{"POSITION":1,"TEXCOORD_0":2}}]}])";
    const Character c = readWell(b.glb());
    EXPECT_EQ(c.cage.vertexCount(), 4u);
    EXPECT_EQ(face(c.cage, 1), (std::vector<uint32_t>{2, 3, 0}));
    EXPECT_EQ(c.cage.sourceVertices, (std::vector<uint32_t>{0, 1, 2, 4}));
    EXPECT_EQ(c.sourceVertexCount, 6u);
    EXPECT_EQ(c.seamVertexCount, 2u);
    ASSERT_EQ(c.cage.cornerUvs.size(), 6u) << "a primitive without UVs gets zeros";
    EXPECT_EQ(c.cage.cornerUvs[1], glm::vec2(0, 0));
    EXPECT_EQ(c.cage.cornerUvs[4], glm::vec2(6, 6));
}

TEST(GltfReader, UnusedVerticesAndDegenerateTrianglesGo) {
    const GltfBuilder b = plainMesh({9, 9, 9, 0, 0, 0, 8, 8, 8, 1, 0, 0, 0, 1, 0}, {1, 3, 4, 1, 1, 4, 0, 0, 0});
    const Character c = readWell(b.glb());
    EXPECT_EQ(c.cage.vertexCount(), 3u);
    EXPECT_EQ(c.cage.sourceVertices, (std::vector<uint32_t>{1, 3, 4}));
    EXPECT_EQ(c.cage.faceCount(), 1u);
    EXPECT_EQ(c.seamVertexCount, 0u);
    EXPECT_EQ(c.warnings, (Strings{"mesh 0: 1 vertex has no face; left out",
                                   "mesh 0 primitive 0: 2 triangles with a repeated vertex; left out"}));
}

// ---- accessors ------------------------------------------------------------------------------------------------------

TEST(GltfReader, StridesAndOffsets) {
    // Positions and UVs interleaved: 12 + 8 bytes.
    GltfBuilder b;
    b.addFloats("SCALAR", {0, 0, 0, 5, 6, 1, 0, 0, 7, 8, 0, 1, 0, 9, 10});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":1,"TEXCOORD_0":2}}]}])";
    std::string json = b.json();
    json = replaced(json, R"("byteOffset":0,"byteLength":60})", R"("byteLength":60,"byteStride":20})");
    json = replaced(json, R"("type":"SCALAR"})",
                    R"("type":"SCALAR"},{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                    R"({"bufferView":0,"byteOffset":12,"componentType":5126,"count":3,"type":"VEC2"})");
    const Character c = readWell(packGlb(json, b.binary()));
    EXPECT_EQ(c.cage.positions[2], glm::vec3(0, 1, 0));
    EXPECT_EQ(c.cage.cornerUvs[2], glm::vec2(9, 10));
}

TEST(GltfReader, SparseValuesReplace) {
    GltfBuilder b;
    b.addFloats("VEC3", {1, 1, 1, 2, 2, 2, 3, 3, 3});
    b.addIntegers("SCALAR", 5123, {0, 2});
    b.addFloats("VEC3", {0, 0, 0, 0, 1, 0});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0}}]}])";
    const std::string sparse =
        R"(,"sparse":{"count":2,"indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":2}}})";
    const std::string first = R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3")";
    Character c = readWell(packGlb(replaced(b.json(), first + "}", first + sparse), b.binary()));
    EXPECT_EQ(c.cage.positions[0], glm::vec3(0, 0, 0));
    EXPECT_EQ(c.cage.positions[1], glm::vec3(2, 2, 2));
    EXPECT_EQ(c.cage.positions[2], glm::vec3(0, 1, 0));
    // Without a bufferView the rest is zero; here the two zero vertices stay apart: no edge joins them.
    c = readWell(packGlb(replaced(b.json(), first + "}", R"({"componentType":5126,"count":3,"type":"VEC3")" + sparse),
                         b.binary()));
    EXPECT_EQ(c.cage.positions[1], glm::vec3(0, 0, 0));
    EXPECT_EQ(c.cage.positions[2], glm::vec3(0, 1, 0));
}

TEST(GltfReader, IntegerAttributes) {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    b.addIntegers("VEC2", 5123, {0, 65535, 0, 0, 65535, 0}, true);
    b.addIntegers("VEC4", 5121, {255, 0, 51, 255, 0, 0, 0, 0, 0, 0, 0, 0}, true);
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1,"COLOR_0":2}}]}])";
    Character c = readWell(b.glb());
    EXPECT_EQ(c.cage.cornerUvs[0], glm::vec2(0, 1));
    EXPECT_EQ(c.cage.cornerColors[0], glm::vec4(1, 0, 0.2f, 1));

    GltfBuilder rgb;
    rgb.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    rgb.addFloats("VEC3", {0.5f, 0.25f, 1, 0, 0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0});
    rgb.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1}}]}])";
    c = readWell(rgb.glb());
    EXPECT_EQ(c.cage.cornerColors[0], glm::vec4(0.5f, 0.25f, 1, 1));
    EXPECT_EQ(c.cage.cornerColors[2], glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(c.warnings, (Strings{"mesh 0 primitive 0 COLOR_0: 1 value is not finite; 0 instead"}));
}

// ---- creases --------------------------------------------------------------------------------------------------------

TEST(GltfReader, CreasesOfExtras) {
    // A quad of two triangles that share no vertex; vertices 3 and 4 are 0 and 2 again, 6 is nobody's.
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, 9, 9, 9});
    b.addIntegers("SCALAR", 5121, {0, 1, 2, 3, 4, 5});
    const auto read = [&](const std::string& extras) {
        b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1}],"extras":)" + extras + "}]";
        return readWell(b.glb());
    };
    const std::string unused = "mesh 0: 1 vertex has no face; left out";
    Character c = read(R"({"creases":[[1,0,2.5],[2,0,1],[4,3,7],[5,4,10]],"corners":[[5,10],[3,1],[0,4]],"x":[[]]})");
    EXPECT_EQ(c.warnings, Strings{unused});
    ASSERT_EQ(c.cage.creases.size(), 3u) << "both sides of a seam are one edge";
    EXPECT_EQ(std::minmax(c.cage.creases[0].a, c.cage.creases[0].b), std::minmax(0u, 1u));
    EXPECT_EQ(c.cage.creases[0].sharpness, 2.5f);
    EXPECT_EQ(std::minmax(c.cage.creases[1].a, c.cage.creases[1].b), std::minmax(0u, 2u));
    EXPECT_EQ(c.cage.creases[1].sharpness, 7.0f) << "the sharpest counts";
    EXPECT_EQ(std::minmax(c.cage.creases[2].a, c.cage.creases[2].b), std::minmax(2u, 3u));
    ASSERT_EQ(c.cage.sharpVertices.size(), 2u);
    EXPECT_EQ(c.cage.sharpVertices[0].vertex, 3u);
    EXPECT_EQ(c.cage.sharpVertices[0].sharpness, 10.0f);
    EXPECT_EQ(c.cage.sharpVertices[1].vertex, 0u);
    EXPECT_EQ(c.cage.sharpVertices[1].sharpness, 4.0f);

    const auto warningOf = [&](const std::string& extras) {
        const Character bad = read(extras);
        EXPECT_EQ(bad.warnings.size(), 2u) << extras;
        const auto own =
            std::find_if(bad.warnings.begin(), bad.warnings.end(), [&](const std::string& w) { return w != unused; });
        return own == bad.warnings.end() ? std::string() : *own;
    };
    const std::string creases = "mesh 0 extras creases";
    EXPECT_EQ(warningOf(R"({"creases":7})"), creases + ": not an array; ignored");
    EXPECT_EQ(warningOf(R"({"creases":[[0,1,1],7,[]]})"),
              creases + "[1]: not [vertex, vertex, sharpness]; left out, as are 1 more");
    EXPECT_EQ(warningOf(R"({"creases":[[0,-1,1]]})"), creases + "[0]: not a vertex number: -1; left out");
    EXPECT_EQ(warningOf(R"({"creases":[[[[0]],1,1]]})"), creases + "[0]: not a vertex number: [[0]]; left out");
    EXPECT_EQ(warningOf(R"({"creases":[[0,7,1]]})"),
              creases + "[0]: vertex 7 is out of range: the mesh has 7; left out");
    EXPECT_EQ(warningOf(R"({"creases":[[0,6,1]]})"), creases + "[0]: vertex 6 has no face; left out");
    EXPECT_EQ(warningOf(R"({"creases":[[0,3,1]]})"), creases + "[0]: both ends are one vertex of the cage; left out");
    EXPECT_EQ(warningOf(R"({"creases":[[0,1,-1]]})"),
              creases + "[0]: sharpness is not a number of at least 0; left out");
    EXPECT_EQ(warningOf(R"({"creases":[[0,1,1e300]]})"),
              creases + "[0]: sharpness is not a number of at least 0; left out");
    EXPECT_EQ(warningOf(R"({"corners":[[0,1,1]]})"), "mesh 0 extras corners[0]: not [vertex, sharpness]; left out");
    EXPECT_EQ(read("[3]").warnings, Strings{unused});
    EXPECT_EQ(read(R"("creases")").warnings, Strings{unused});
}

// ---- corners --------------------------------------------------------------------------------------------------------

TEST(GltfReader, TwoUvSets) {
    GltfBuilder b = skinnedQuad();
    const std::string second = std::to_string(b.addIntegers("VEC2", 5121, {0, 0, 255, 0, 255, 255, 0, 255}, true));
    b.meshes = replaced(b.meshes, R"("TEXCOORD_0":8)",
                        R"("TEXCOORD_0":8,"TEXCOORD_1":)" + second + R"(,"TEXCOORD_2":)" + second);
    b.more += R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1,)"
              R"("extensions":{"KHR_texture_transform":{}}}}}],"textures":[{"source":0}],)"
              R"("images":[{"uri":"data:image/png;base64,iVBORw0KGgo="}])";
    const Character c = readWell(b.glb());
    ASSERT_EQ(c.cage.cornerUvs1.size(), 6u);
    EXPECT_EQ(c.cage.cornerUvs1[1], glm::vec2(1, 0));
    EXPECT_EQ(c.cage.cornerUvs1[4], glm::vec2(1, 1));
    EXPECT_EQ(c.materials[0].baseColorTexture.uvSet, 1u);
    EXPECT_EQ(c.warnings, (Strings{"mesh 0 primitive 0: only TEXCOORD_0 and TEXCOORD_1 are read"}));
}

} // namespace
} // namespace supple::cage
