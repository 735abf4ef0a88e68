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
              "two?lines: image 0 uri: \"a?b.png\": external files are not allowed for an asset read from memory; left "
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
    EXPECT_EQ(c.warnings,
              (Strings{"t.glb: node 3: the mesh of this node is read; 1 other node with a mesh is left out"}));
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
    EXPECT_EQ(c.warnings, (Strings{"t.glb: mesh 0 primitive 0: LINES instead of TRIANGLES; left out",
                                   "t.glb: mesh 0 primitive 2: TRIANGLE_STRIP instead of TRIANGLES; left out"}));
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
    EXPECT_EQ(c.warnings, (Strings{"t.glb: mesh 0: 1 vertex has no triangle; left out",
                                   "t.glb: mesh 0 primitive 0: 2 triangles with a repeated vertex left out"}));
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
    EXPECT_EQ(c.warnings, (Strings{"t.glb: mesh 0 primitive 0 COLOR_0: 1 value is not finite; 0 instead"}));
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
    EXPECT_EQ(c.warnings, (Strings{"t.glb: mesh 0 WEIGHTS: normalised: they do not sum to 1 at 2 vertices, largest "
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
    EXPECT_EQ(c.warnings,
              (Strings{"t.glb: mesh 0 WEIGHTS: all zero at 2 vertices; bound to the first joint named there"}));
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
    EXPECT_EQ(c.warnings, (Strings{"t.glb: mesh 0: 1 vertex agrees with another in position but not in skin (first: "
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
              R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":1,"texCoord":1}}}],)"
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
    EXPECT_EQ(
        c.warnings,
        (Strings{"t.glb: image 0 uri: \"gone.png\": external files are not allowed for an asset read from memory; "
                 "left out",
                 "t.glb: material 2 alphaMode: \"GLASS\" is unknown; opaque",
                 "t.glb: material 3 baseColorTexture: only TEXCOORD_0 is read"}));
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
    EXPECT_EQ(c->warnings, (Strings{"t.glb: image 2 uri: \"../a.png\": path leaves the asset's folder; left out",
                                    "t.glb: image 3 uri: \"textures/none.png\": no such file; left out"}));
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
    EXPECT_EQ(c.warnings, (Strings{"t.glb: animation 0: 1 channel of KHR_animation_pointer or no node ignored",
                                   "t.glb: animation 0: 1 channel of weights ignored"}));
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

TEST(GltfReader, MorphTargetsAreIgnoredByName) {
    GltfBuilder b = skinnedQuad();
    b.meshes = replaced(b.meshes, R"("mode":4)", R"("targets":[{"POSITION":0}])");
    EXPECT_EQ(readWell(b.glb()).warnings, (Strings{"t.glb: mesh 0: morph targets are ignored"}));
}

} // namespace
} // namespace supple::cage
