#include "cage/gltf_reader.h"
#include "cage/topology.h"
#include "tests/cage/gltf_builder.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <unistd.h>

namespace supple::cage {
namespace {

using namespace test;

Character readWell(const std::vector<std::byte>& bytes, const GltfOptions& options = {}) {
    Result<Character> result = readGltf(bytes, "t.glb", "", options);
    EXPECT_TRUE(result.ok()) << result.error().message;
    return result.ok() ? std::move(result.value()) : Character{};
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return place == std::string::npos ? text : text.replace(place, from.size(), to);
}

using Strings = std::vector<std::string>;

std::vector<uint32_t> face(const Cage& cage, uint32_t f) {
    return {cage.faceVertices.begin() + cage.faceStarts[f], cage.faceVertices.begin() + cage.faceStarts[f + 1]};
}

/// An unskinned mesh over one set of attributes.
GltfBuilder plainMesh(const std::vector<float>& positions, const std::vector<uint32_t>& indices,
                      const std::string& primitiveMore = "") {
    GltfBuilder b;
    b.addFloats("VEC3", positions);
    b.addIntegers("SCALAR", 5125, indices);
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1)" + primitiveMore + "}]}]";
    return b;
}

TEST(GltfReader, SkinnedQuad) {
    for (const auto& bytes : {skinnedQuad().glb(), skinnedQuad().embedded()}) {
        const Character c = readWell(bytes);
        EXPECT_EQ(c.name, "t.glb");
        EXPECT_EQ(c.warnings, Strings());
        EXPECT_EQ(c.polygonSource, PolygonSource::triangles);
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
    const Result<Character> result = readGltf(b.glb(), "two\nlines", "");
    ASSERT_TRUE(result.ok());
    ASSERT_EQ(result->warnings.size(), 1u);
    EXPECT_EQ(result->warnings[0],
              "image 0 uri: \"a?b.png\": external files are not allowed for an asset read from memory; left "
              "out");
}

// ---- which mesh -----------------------------------------------------------------------------------------------------

TEST(GltfReader, SkinnedMeshComesBeforeOthers) {
    GltfBuilder b = skinnedQuad();
    const std::string primitive = R"({"attributes":{"POSITION":0},"indices":3})";
    b.meshes =
        R"([{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3}]},{"primitives":[)" +
        primitive + "," + primitive + "]}]";
    b.nodes = R"([{"mesh":1},{"name":"root","children":[2]},{"name":"tip"},{"mesh":0,"skin":0}])";
    b.more = replaced(b.more, R"("nodes":[0,1])", R"("nodes":[0,1,3])");
    const Character c = readWell(b.glb());
    EXPECT_EQ(c.cage.faceCount(), 2u);
    EXPECT_EQ(c.skin.joints.size(), 2u);
    EXPECT_EQ(c.warnings, (Strings{"node 3: the mesh of this node is read; 1 other node with a mesh is left out"}));
}

TEST(GltfReader, SceneOrderComesBeforeNodeOrder) {
    GltfBuilder b = skinnedQuad();
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":3}]},)"
               R"({"primitives":[{"attributes":{"POSITION":0},"indices":3}]}])";
    b.nodes = R"([{"mesh":0},{"mesh":1},{"children":[1]}])";
    b.more = R"(,"scenes":[{"nodes":[0]},{"nodes":[2,0]}],"scene":1)";
    EXPECT_EQ(readWell(b.glb()).skin.joints, std::vector<uint32_t>{1});
    b.more = R"(,"scenes":[{"nodes":[0]},{"nodes":[2,0]}])";
    EXPECT_EQ(readWell(b.glb()).skin.joints, std::vector<uint32_t>{0});
    b.more = "";
    EXPECT_EQ(readWell(b.glb()).skin.joints, std::vector<uint32_t>{0});
}

TEST(GltfReader, UnskinnedMeshHangsOnItsNode) {
    GltfBuilder b = skinnedQuad();
    b.nodes = R"([{},{"mesh":0,"scale":[-2,2,2]},{}])";
    const Character c = readWell(b.glb());
    EXPECT_EQ(c.skin.joints, std::vector<uint32_t>{1});
    EXPECT_EQ(c.skin.inverseBinds[0], glm::mat4(1.0f));
    EXPECT_EQ(c.weights.starts, (std::vector<uint32_t>{0, 1, 2, 3, 4}));
    for (const Influence& influence : c.weights.influences) {
        EXPECT_EQ(influence.joint, 0u);
        EXPECT_EQ(influence.weight, 1.0f);
    }
}

TEST(GltfReader, OtherPrimitiveModesAreLeftOut) {
    GltfBuilder b = skinnedQuad();
    const std::string triangles = R"({"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3})";
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"mode":1},)" + triangles +
               R"(,{"attributes":{"POSITION":0},"mode":5}]}])";
    const Character c = readWell(b.glb());
    EXPECT_EQ(c.cage.faceCount(), 2u);
    EXPECT_EQ(c.warnings, (Strings{"mesh 0 primitive 0: LINES instead of TRIANGLES; left out",
                                   "mesh 0 primitive 2: TRIANGLE_STRIP instead of TRIANGLES; left out"}));
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
                                   "mesh 0 primitive 0: 2 triangles with a repeated vertex left out"}));
}

// ---- polygons -------------------------------------------------------------------------------------------------------

TEST(GltfReader, NgonEncodingWhereThePrimitiveCarriesIt) {
    const std::vector<float> grid = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
    const std::vector<uint32_t> quads = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
    GltfBuilder b = plainMesh(grid, quads, R"(,"extensions":{"FB_ngon_encoding":{}})");
    Character c = readWell(b.glb());
    EXPECT_EQ(c.polygonSource, PolygonSource::ngonEncoding);
    ASSERT_EQ(c.cage.faceCount(), 2u);
    EXPECT_EQ(face(c.cage, 0), (std::vector<uint32_t>{0, 1, 4, 3}));
    EXPECT_EQ(face(c.cage, 1), (std::vector<uint32_t>{1, 2, 5, 4}));

    // Assimp lists the extension as used whether or not a primitive has it.
    b = plainMesh(grid, quads);
    b.more = R"(,"extensionsUsed":["FB_ngon_encoding"])";
    c = readWell(b.glb());
    EXPECT_EQ(c.polygonSource, PolygonSource::triangles);
    EXPECT_EQ(c.cage.faceCount(), 4u);
}

TEST(GltfReader, PairingIsOptIn) {
    const std::vector<float> grid = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
    GltfBuilder b = plainMesh(grid, {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4});
    EXPECT_EQ(readWell(b.glb()).cage.faceCount(), 4u);
    const Character c = readWell(b.glb(), {.pairQuads = true});
    EXPECT_EQ(c.polygonSource, PolygonSource::pairedTriangles);
    ASSERT_EQ(c.cage.faceCount(), 2u);
    EXPECT_EQ(face(c.cage, 0), (std::vector<uint32_t>{0, 1, 4, 3}));
    EXPECT_EQ(face(c.cage, 1), (std::vector<uint32_t>{1, 2, 5, 4}));

    // A UV seam on the diagonal says that these were two faces.
    GltfBuilder seam;
    seam.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0});
    seam.addFloats("VEC2", {0, 0, 1, 0, 1, 1, 0, 0.5f, 1, 1, 0, 1});
    seam.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1}}]}])";
    EXPECT_EQ(readWell(seam.glb(), {.pairQuads = true}).cage.faceCount(), 2u);
    // A fold over the shared edge too.
    const GltfBuilder fold = plainMesh({0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 0, 0.1f}, {0, 1, 2, 0, 2, 3});
    EXPECT_EQ(readWell(fold.glb(), {.pairQuads = true}).cage.faceCount(), 2u);
}

TEST(GltfReader, EncodedPolygonsAreNeverPaired) {
    const GltfBuilder b =
        plainMesh({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {0, 1, 2, 2, 3, 0}, R"(,"extensions":{"FB_ngon_encoding":{}})");
    const Character c = readWell(b.glb(), {.pairQuads = true});
    EXPECT_EQ(c.polygonSource, PolygonSource::ngonEncoding);
    EXPECT_EQ(c.cage.faceCount(), 2u);
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

// ---- weights --------------------------------------------------------------------------------------------------------

/// One triangle; joints and weights of its vertices, in sets of four.
Character withWeights(const std::vector<std::vector<uint32_t>>& joints,
                      const std::vector<std::vector<float>>& weights) {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    std::string attributes = R"("POSITION":0)";
    for (size_t n = 0; n < joints.size(); ++n) {
        attributes += ",\"JOINTS_" + std::to_string(n) + "\":" + std::to_string(b.addIntegers("VEC4", 5123, joints[n]));
        attributes += ",\"WEIGHTS_" + std::to_string(n) + "\":" + std::to_string(b.addFloats("VEC4", weights[n]));
    }
    b.meshes = R"([{"primitives":[{"attributes":{)" + attributes + "}}]}]";
    b.nodes = R"([{"mesh":0,"skin":0},{},{},{}])";
    b.more = R"(,"skins":[{"joints":[1,2,3]}])";
    return readWell(b.glb());
}

TEST(GltfReader, InverseBindsAreOptional) {
    const Character c = withWeights({std::vector<uint32_t>(12, 0)}, {{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}});
    EXPECT_EQ(c.skin.inverseBinds, std::vector<glm::mat4>(3, glm::mat4(1.0f)));
    EXPECT_EQ(c.warnings, Strings());
}

TEST(GltfReader, WeightsAreNormalisedWithOneWarning) {
    const Character c =
        withWeights({{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}}, {{0.5f, 0.5f, 0, 0, 0.25f, 0.25f, 0, 0, 1.5f, 0.5f, 0, 0}});
    EXPECT_EQ(c.weights.influences[2].weight, 0.5f);
    EXPECT_EQ(c.weights.influences[4].weight, 0.75f);
    EXPECT_EQ(c.warnings, (Strings{"mesh 0 WEIGHTS: normalised: they do not sum to 1 at 2 vertices, largest "
                                   "deviation 1"}));
    // Rounding is nobody's fault.
    EXPECT_EQ(withWeights({{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}},
                          {{0.5f, 0.50005f, 0, 0, 0.5f, 0.5f, 0, 0, 0.5f, 0.49995f, 0, 0}})
                  .warnings,
              Strings());
}

TEST(GltfReader, SeveralSetsAndRepeatedJoints) {
    const std::vector<uint32_t> j0 = {2, 1, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    const std::vector<uint32_t> j1 = {1, 9, 9, 9, 0, 0, 0, 0, 0, 0, 0, 0};
    const Character c = withWeights(
        {j0, j1}, {{0.25f, 0.125f, 0.25f, 0, 1, 0, 0, 0, 1, 0, 0, 0}, {0.375f, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}});
    ASSERT_EQ(c.weights.starts[1], 2u) << "joints named twice are merged, joints of zero weight dropped";
    EXPECT_EQ(c.weights.influences[0].joint, 1u);
    EXPECT_EQ(c.weights.influences[0].weight, 0.5f);
    EXPECT_EQ(c.weights.influences[1].joint, 2u);
    EXPECT_EQ(c.weights.influences[1].weight, 0.5f);
}

TEST(GltfReader, VerticesWithoutWeightHangOnTheirFirstJoint) {
    const Character c = withWeights({{1, 2, 0, 0, 7, 0, 0, 0, 0, 0, 0, 0}}, {{0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}});
    EXPECT_EQ(c.weights.starts, (std::vector<uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(c.weights.influences[0].joint, 1u);
    EXPECT_EQ(c.weights.influences[1].joint, 0u) << "out of range";
    EXPECT_EQ(c.weights.influences[0].weight, 1.0f);
    EXPECT_EQ(c.warnings, (Strings{"mesh 0 WEIGHTS: all zero at 2 vertices; bound to the first joint named there"}));
}

TEST(GltfReader, EightBitWeightsRoundSilently) {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    b.addIntegers("VEC4", 5121, {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    b.addIntegers("VEC4", 5121, {128, 128, 0, 0, 127, 127, 0, 0, 255, 0, 0, 0}, true);
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}])";
    b.nodes = R"([{"mesh":0,"skin":0},{},{}])";
    b.more = R"(,"skins":[{"joints":[1,2]}])";
    const Character c = readWell(b.glb());
    EXPECT_EQ(c.warnings, Strings());
    EXPECT_EQ(c.weights.influences[0].weight, 0.5f);
    EXPECT_EQ(c.weights.influences[2].weight, 0.5f);
}

// ---- seams ----------------------------------------------------------------------------------------------------------

TEST(GltfReader, SeamVerticesWithDifferentSkinStayApart) {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0});
    b.addIntegers("VEC4", 5121, std::vector<uint32_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, //
                                                      0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    b.addFloats("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}])";
    b.nodes = R"([{"mesh":0,"skin":0},{},{}])";
    b.more = R"(,"skins":[{"joints":[1,2]}])";
    const Character c = readWell(b.glb());
    EXPECT_EQ(c.warnings, (Strings{"mesh 0: 1 vertex agrees with another in position but not in skin (first: "
                                   "vertices 2 and 4); kept apart"}));
    EXPECT_EQ(c.cage.vertexCount(), 6u) << "the other end of the seam edge has no partner edge either";
}

TEST(GltfReader, TriangleSoupBecomesWhole) {
    // A tetrahedron, every corner its own vertex.
    const glm::vec3 p[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    std::vector<float> soup;
    for (const int v : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3})
        for (int k = 0; k < 3; ++k)
            soup.push_back(p[v][k]);
    GltfBuilder b;
    b.addFloats("VEC3", soup);
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0}}]}])";
    const Character c = readWell(b.glb());
    EXPECT_EQ(c.cage.vertexCount(), 4u);
    EXPECT_EQ(c.seamVertexCount, 8u);
    EXPECT_EQ(c.cage.sourceVertices, (std::vector<uint32_t>{0, 1, 2, 5}));
    EXPECT_TRUE(buildTopology(c.cage).ok());
}

// ---- materials and images -------------------------------------------------------------------------------------------

TEST(GltfReader, Materials) {
    GltfBuilder b = skinnedQuad();
    b.meshes = replaced(b.meshes, R"("mode":4)", R"("material":0)");
    b.more += R"(,"materials":[{"name":"skin","alphaMode":"MASK","alphaCutoff":0.25,"doubleSided":true,)"
              R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,1,0,1],"baseColorTexture":{"index":0}}},)"
              R"({"alphaMode":"BLEND"},{"alphaMode":"GLASS"},)"
              R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":2}}}],)"
              R"("textures":[{"source":1,"sampler":0},{"source":0}],"samplers":[{"wrapS":33071,"wrapT":33648}],)"
              R"("images":[{"uri":"gone.png"},{"uri":"data:image/png;base64,iVBORw0KGgo=","name":"face"}])";
    const Character c = readWell(b.glb());
    ASSERT_EQ(c.materials.size(), 4u);
    EXPECT_EQ(c.materials[0].name, "skin");
    EXPECT_EQ(c.materials[0].baseColorFactor, glm::vec4(0.5f, 1, 0, 1));
    EXPECT_EQ(c.materials[0].baseColorImage, 1u);
    EXPECT_EQ(c.materials[0].wrapU, Wrap::clampToEdge);
    EXPECT_EQ(c.materials[0].wrapV, Wrap::mirroredRepeat);
    EXPECT_EQ(c.materials[0].alphaMode, AlphaMode::mask);
    EXPECT_EQ(c.materials[0].alphaCutoff, 0.25f);
    EXPECT_TRUE(c.materials[0].doubleSided);
    EXPECT_EQ(c.materials[1].alphaMode, AlphaMode::blend);
    EXPECT_EQ(c.materials[1].alphaCutoff, 0.5f);
    EXPECT_EQ(c.materials[1].baseColorFactor, glm::vec4(1.0f));
    EXPECT_EQ(c.materials[2].alphaMode, AlphaMode::opaque);
    EXPECT_EQ(c.materials[3].baseColorImage, kNone) << "its image is missing";
    EXPECT_EQ(c.cage.faceMaterials, (std::vector<uint32_t>{0, 0}));
    ASSERT_EQ(c.images.size(), 2u);
    EXPECT_TRUE(c.images[0].bytes.empty());
    EXPECT_EQ(c.images[1].name, "face");
    EXPECT_EQ(c.images[1].mimeType, "image/png");
    EXPECT_EQ(c.images[1].bytes.size(), 8u);
    EXPECT_EQ(c.warnings,
              (Strings{"image 0 uri: \"gone.png\": external files are not allowed for an asset read from memory; "
                       "left out",
                       "material 2 alphaMode: \"GLASS\" is unknown; opaque",
                       "material 3 baseColorTexture: texCoord 2: only TEXCOORD_0 and TEXCOORD_1 are read; left out"}));
}

TEST(GltfReader, ImagesFromBufferViewsAndFiles) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(testing::TempDir()) / ("supple_gltf_images_" + std::to_string(getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder / "textures");
    std::ofstream(folder / "textures" / "a b.jpg", std::ios::binary) << "\xFF\xD8\xFF\xE0 not really";
    GltfBuilder b = skinnedQuad();
    const int view = b.addIntegers("SCALAR", 5121, {0x89, 'P', 'N', 'G', 1, 2, 3});
    b.more += R"(,"images":[{"bufferView":)" + std::to_string(view) +
              R"(},{"uri":"textures/a%20b.jpg"},{"uri":"../a.png"},{"uri":"textures/none.png"}])";
    const auto bytes = b.glb();
    std::ofstream(folder / "t.glb", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    const Result<Character> c = readGltfFile((folder / "t.glb").string());
    ASSERT_TRUE(c.ok()) << c.error().message;
    ASSERT_EQ(c->images.size(), 4u);
    EXPECT_EQ(c->images[0].bytes.size(), 7u);
    EXPECT_EQ(c->images[0].mimeType, "image/png");
    EXPECT_EQ(c->images[1].bytes.size(), 15u);
    EXPECT_EQ(c->images[1].mimeType, "image/jpeg");
    EXPECT_EQ(c->warnings, (Strings{"image 2 uri: \"../a.png\": path leaves the asset's folder; left out",
                                    "image 3 uri: \"textures/none.png\": no such file; left out"}));
    fs::remove_all(folder);
}

// ---- clips ----------------------------------------------------------------------------------------------------------

TEST(GltfReader, IntegerRotationsAreDequantised) {
    GltfBuilder b = skinnedQuad();
    const int bytes = b.addIntegers("VEC4", 5120, {0, 0, 0, 127, 0, 0, 0x81, 0, 90, 90, 0x80, 0}, true);
    const int shorts = b.addIntegers("VEC4", 5122, {0, 0, 0, 32767, 0, 0, 0x8000, 0, 0, 32767, 0, 0}, true);
    b.more = replaced(b.more, R"({"input":5,"output":6},{"input":5,"output":7})",
                      R"({"input":5,"output":)" + std::to_string(bytes) + R"(},{"input":5,"output":)" +
                          std::to_string(shorts) + R"(,"interpolation":"STEP"})");
    b.more = replaced(b.more, R"({"sampler":1,"target":{"node":2,"path":"translation"}})",
                      R"({"sampler":1,"target":{"node":1,"path":"rotation"}})");
    const Character c = readWell(b.glb());
    const auto& first = c.clips[0].channels[0].values;
    EXPECT_EQ(std::vector<float>(first.begin(), first.begin() + 8), (std::vector<float>{0, 0, 0, 1, 0, 0, -1, 0}));
    const double length = std::sqrt(double(first[8]) * first[8] + double(first[9]) * first[9] +
                                    double(first[10]) * first[10] + double(first[11]) * first[11]);
    EXPECT_NEAR(length, 1.0, 1e-6) << "8-bit rotations are far from unit length";
    EXPECT_NEAR(first[8], 90.0 / std::sqrt(2 * 90.0 * 90.0 + 127.0 * 127.0), 1e-6);
    EXPECT_EQ(c.clips[0].channels[1].values, (std::vector<float>{0, 0, 0, 1, 0, 0, -1, 0, 0, 1, 0, 0}));
    EXPECT_EQ(c.clips[0].channels[1].interpolation, Interpolation::step);
}

TEST(GltfReader, ForeignChannelsAreIgnoredByName) {
    GltfBuilder b = skinnedQuad();
    b.more = replaced(b.more, R"("channels":[)",
                      R"("channels":[{"sampler":0,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":)"
                      R"({"pointer":"/nodes/0/weights"}}}},{"sampler":9,"target":{"node":0,"path":"weights"}},)");
    b.more = replaced(b.more, R"("sampler":9)", R"("sampler":0)");
    const Character c = readWell(b.glb());
    ASSERT_EQ(c.clips[0].channels.size(), 2u);
    EXPECT_EQ(c.warnings,
              (Strings{"animation 0: 1 channel of KHR_animation_pointer or no node ignored",
                       "animation 0: 1 channel of weights of nodes without the mesh's morph targets ignored"}));
}

TEST(GltfReader, ClipsKeepTheirNumbers) {
    GltfBuilder b = skinnedQuad();
    b.more = replaced(b.more, R"("animations":[)",
                      R"("animations":[{"name":"smile","samplers":[{"input":5,"output":5}],)"
                      R"("channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}]},)");
    const Character c = readWell(b.glb());
    ASSERT_EQ(c.clips.size(), 2u);
    EXPECT_EQ(c.clips[0].name, "smile");
    EXPECT_TRUE(c.clips[0].channels.empty());
    EXPECT_EQ(c.clips[0].duration, 0.0);
    EXPECT_EQ(c.clips[1].name, "clip_1");
}

TEST(GltfReader, KeysOfWeights) {
    GltfBuilder b = skinnedQuad();
    const int dense = b.addFloats("VEC3", {0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 2});
    b.meshes = replaced(b.meshes, R"("mode":4)",
                        R"("targets":[{"POSITION":)" + std::to_string(dense) + R"(},{"POSITION":)" +
                            std::to_string(dense) + "}]");
    const int linear = b.addFloats("SCALAR", {0, 1, 0.5f, 0.25f, 1, 0});
    const int bytes = b.addIntegers("SCALAR", 5120, {0, 127, 0x81, 0x80, 0, 127}, true);
    const int cubic = b.addIntegers("SCALAR", 5123, std::vector<uint32_t>(18, 65535), true);
    const auto sampler = [](int output, const char* interpolation) {
        return R"({"input":5,"output":)" + std::to_string(output) + R"(,"interpolation":")" + interpolation + "\"}";
    };
    const std::string clip = R"(],"channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}]})";
    b.more =
        replaced(b.more, R"("animations":[)",
                 R"("animations":[{"samplers":[)" + sampler(linear, "LINEAR") + clip + R"(,{"samplers":[)" +
                     sampler(bytes, "STEP") + clip + R"(,{"samplers":[)" + sampler(cubic, "CUBICSPLINE") + clip + ",");
    const Character c = readWell(b.glb());
    EXPECT_EQ(c.warnings, Strings());
    ASSERT_EQ(c.clips.size(), 4u);
    for (size_t i = 0; i < 3; ++i) {
        ASSERT_EQ(c.clips[i].channels.size(), 1u);
        EXPECT_EQ(c.clips[i].channels[0].path, ChannelPath::weights);
        EXPECT_EQ(c.clips[i].channels[0].node, c.meshNode);
        EXPECT_EQ(c.clips[i].duration, 2.0);
    }
    EXPECT_EQ(c.clips[0].channels[0].values, (std::vector<float>{0, 1, 0.5f, 0.25f, 1, 0}));
    EXPECT_EQ(c.clips[1].channels[0].values, (std::vector<float>{0, 1, -1, -1, 0, 1}));
    EXPECT_EQ(c.clips[1].channels[0].interpolation, Interpolation::step);
    EXPECT_EQ(c.clips[2].channels[0].values, std::vector<float>(18, 1.0f)) << "three values a key and target";
}

// ---- morph targets --------------------------------------------------------------------------------------------------

TEST(GltfReader, MorphTargets) {
    GltfBuilder b = skinnedQuad();
    const std::string dense = std::to_string(b.addFloats("VEC3", {0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 2, 0}));
    b.meshes =
        replaced(b.meshes, R"("mode":4)",
                 R"("targets":[{"POSITION":)" + dense + R"(},{"NORMAL":0,"TANGENT":0},{"POSITION":)" + dense + "}]");
    Character c = readWell(b.glb());
    EXPECT_EQ(c.warnings, Strings());
    EXPECT_EQ(c.meshNode, 0u);
    ASSERT_EQ(c.morphs.targets.size(), 3u);
    EXPECT_EQ(c.morphs.targets[0].vertices, (std::vector<uint32_t>{0, 3})) << "only those that move";
    EXPECT_EQ(c.morphs.targets[0].deltas, (std::vector<glm::vec3>{{0, 0, 1}, {0, 2, 0}}));
    EXPECT_EQ(c.morphs.targets[0].name, "");
    EXPECT_TRUE(c.morphs.targets[1].vertices.empty());
    EXPECT_EQ(c.morphs.targets[2].vertices, c.morphs.targets[0].vertices);
    EXPECT_EQ(c.morphs.weights, (std::vector<float>{0, 0, 0}));

    b.meshes = replaced(b.meshes, R"([{"primitives")",
                        R"([{"weights":[0.25,0.5,1],"extras":{"targetNames":["smile",7,"frown"]},"primitives")");
    c = readWell(b.glb());
    EXPECT_EQ(c.morphs.weights, (std::vector<float>{0.25f, 0.5f, 1}));
    EXPECT_EQ(c.morphs.targets[0].name, "smile");
    EXPECT_EQ(c.morphs.targets[1].name, "");
    EXPECT_EQ(c.morphs.targets[2].name, "frown");
    EXPECT_EQ(c.warnings, (Strings{"mesh 0 extras targetNames[1]: not a string; ignored"}));
    b.nodes = replaced(b.nodes, R"("mesh":0)", R"("mesh":0,"weights":[1,0,-1])");
    EXPECT_EQ(readWell(b.glb()).morphs.weights, (std::vector<float>{1, 0, -1})) << "the node's come before the mesh's";
}

TEST(GltfReader, SparseMorphTargets) {
    GltfBuilder b = skinnedQuad();
    const int base = b.addFloats("VEC3", {1, 1, 1, 2, 2, 2, 0, 0, 0, 3, 3, 3});
    const int indices = b.addIntegers("SCALAR", 5121, {1, 3});
    const int values = b.addFloats("VEC3", {5, 0, 0, 0, 0, 0});
    b.meshes = replaced(b.meshes, R"("mode":4)", R"("targets":[{"POSITION":)" + std::to_string(base) + "}]");
    const std::string dense = R"({"bufferView":)" + std::to_string(base) + R"(,"componentType":5126,"count":4)";
    const std::string sparse = R"(,"sparse":{"count":2,"indices":{"bufferView":)" + std::to_string(indices) +
                               R"(,"componentType":5121},"values":{"bufferView":)" + std::to_string(values) + "}}";
    Character c = readWell(packGlb(replaced(b.json(), dense, dense + sparse), b.binary()));
    EXPECT_EQ(c.morphs.targets[0].vertices, (std::vector<uint32_t>{0, 1})) << "values replace, also by zero";
    EXPECT_EQ(c.morphs.targets[0].deltas, (std::vector<glm::vec3>{{1, 1, 1}, {5, 0, 0}}));
    c = readWell(packGlb(replaced(b.json(), dense, R"({"componentType":5126,"count":4)" + sparse), b.binary()));
    EXPECT_EQ(c.morphs.targets[0].vertices, (std::vector<uint32_t>{1}));
    EXPECT_EQ(c.morphs.targets[0].deltas, (std::vector<glm::vec3>{{5, 0, 0}}));
}

TEST(GltfReader, MorphTargetsOfSeveralPrimitives) {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0});
    b.addFloats("VEC3", {1, 1, 0, 0, 1, 0, 0, 0, 0});
    b.addFloats("VEC3", {0, 0, 0, 0, 0, 0, 0, 0, 3});
    b.addFloats("VEC3", {0, 0, 3, 0, 0, 4, 0, 0, 0});
    b.addFloats("VEC3", {0, 0, 5, 0, 0, 4, 0, 0, 0});
    const auto meshes = [](int second) {
        return R"([{"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":2}]},)"
               R"({"attributes":{"POSITION":1},"targets":[{"POSITION":)" +
               std::to_string(second) + "}]}]}]";
    };
    b.meshes = meshes(3);
    Character c = readWell(b.glb());
    EXPECT_EQ(c.warnings, Strings());
    EXPECT_EQ(c.cage.vertexCount(), 4u);
    EXPECT_EQ(c.morphs.targets[0].vertices, (std::vector<uint32_t>{2, 3}));
    EXPECT_EQ(c.morphs.targets[0].deltas, (std::vector<glm::vec3>{{0, 0, 3}, {0, 0, 4}}));
    // What moves apart is not welded.
    b.meshes = meshes(4);
    c = readWell(b.glb());
    EXPECT_EQ(c.cage.vertexCount(), 6u);
    EXPECT_EQ(c.warnings, (Strings{"mesh 0: 1 vertex agrees with another in position but not in morph targets (first: "
                                   "vertices 2 and 3); kept apart"}));
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
        return bad.warnings.empty() ? std::string() : bad.warnings.back();
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
    EXPECT_EQ(c.materials[0].baseColorUvSet, 1u);
    EXPECT_EQ(c.warnings, (Strings{"material 0 baseColorTexture: KHR_texture_transform is ignored",
                                   "mesh 0 primitive 0: only TEXCOORD_0 and TEXCOORD_1 are read"}));
}

// ---- files of the host ----------------------------------------------------------------------------------------------

TEST(GltfReader, FilesComeFromTheHost) {
    GltfBuilder b = skinnedQuad();
    b.more += R"(,"images":[{"uri":"./tex/a%20b.png"},{"uri":"../up.png"},{"uri":"none.png"}])";
    std::vector<std::string> asked;
    GltfOptions options;
    options.readFile = [&](const std::string& path) -> Result<std::vector<std::byte>> {
        asked.push_back(path);
        if (path == "none.png") {
            return Error{ErrorCode::io, "not in this archive"};
        }
        return path == "quad.bin" ? b.binary() : std::vector<std::byte>(3);
    };
    Result<Character> c = readGltf(toBytes(b.json("quad.bin")), "t.gltf", "/nowhere", options);
    ASSERT_TRUE(c.ok()) << c.error().message;
    EXPECT_EQ(asked, (Strings{"quad.bin", "./tex/a b.png", "none.png"})) << "decoded, and only what may be asked for";
    EXPECT_EQ(c->images[0].bytes.size(), 3u);
    EXPECT_EQ(c->warnings, (Strings{"image 1 uri: \"../up.png\": path leaves the asset's folder; left out",
                                    "image 2 uri: \"none.png\": not in this archive; left out"}));

    options.readFile = [](const std::string&) -> Result<std::vector<std::byte>> {
        return Error{ErrorCode::io, "offline"};
    };
    c = readGltf(toBytes(b.json("quad.bin")), "t.gltf", "", options);
    ASSERT_FALSE(c.ok());
    EXPECT_EQ(c.error().code, ErrorCode::io);
    EXPECT_EQ(c.error().message, "t.gltf: buffer 0 uri: \"quad.bin\": offline");
    EXPECT_EQ(readGltf(toBytes(b.json("../quad.bin")), "t.gltf", "", options).error().message,
              "t.gltf: buffer 0 uri: \"../quad.bin\": path leaves the asset's folder");
}

} // namespace
} // namespace supple::cage
