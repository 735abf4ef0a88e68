// What a fault costs beside itself: what counts on something that is left out is left out with it, and nothing else.
#include "cage/leniency.h"
#include "tests/cage/gltf/compressed.h"
#include "tests/cage/gltf/reading.h"

#include <gtest/gtest.h>
#include <limits>

namespace supple::cage {
namespace {

using namespace test;

/// Two triangles in two primitives, with creases and corners in the extras of their mesh, by vertices of the second.
GltfBuilder twoWithExtras(const std::string& firstMore) {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    b.addFloats("VEC3", {5, 0, 0, 6, 0, 0, 5, 1, 0});
    b.addIntegers("SCALAR", 5123, {0, 1, 3});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0})" + firstMore +
               R"(},{"attributes":{"POSITION":1}}],"extras":{"creases":[[3,4,2]],"corners":[[2,1]]}}])";
    return b;
}

TEST(GltfLeftOut, ExtrasThatCountVerticesOfALostPrimitive) {
    GltfBuilder nan = twoWithExtras("");
    nan.setFloat(static_cast<QuadAccessor>(0), 4, std::numeric_limits<float>::quiet_NaN());
    for (const GltfBuilder& b : {nan, twoWithExtras(R"(,"mode":9)")}) {
        const Character c = readWell(b);
        EXPECT_EQ(c.cage.faceCount(), 1u);
        EXPECT_TRUE(c.cage.creases.empty());
        EXPECT_TRUE(c.cage.sharpVertices.empty()) << "vertex 2 is now one of the second primitive";
        ASSERT_EQ(c.warnings.size(), 2u);
        EXPECT_EQ(
            c.warnings[0],
            "mesh 0 extras creases and corners: they count the vertices of a primitive that is left out; left out");
    }
    // Vertices that were read before the primitive was left out are counted.
    const Character c = readWell(twoWithExtras(R"(,"indices":2)"));
    ASSERT_EQ(c.cage.creases.size(), 1u);
    EXPECT_EQ(c.cage.positions[c.cage.creases[0].a], glm::vec3(5, 0, 0));
    EXPECT_EQ(c.cage.positions[c.cage.creases[0].b], glm::vec3(6, 0, 0));
}

TEST(GltfLeftOut, PartsOfAMaterial) {
    GltfBuilder b = skinnedQuad();
    b.more += R"(,"materials":[{"name":"skin","pbrMetallicRoughness":7}])";
    const Character c = readWell(b);
    EXPECT_EQ(c.materials[0].name, "skin");
    EXPECT_EQ(c.warnings, (Strings{"material 0 pbrMetallicRoughness: not an object; left out"}));
}

/// The quad with an extension on its primitive. `more`: accessors from 9 on.
GltfBuilder extendedQuad(const std::string& extensions, const std::string& required = "") {
    GltfBuilder b = skinnedQuad();
    b.addIntegers("SCALAR", 5121, {0, 1, 9, 9}); // 9
    b.addFloats("SCALAR", {2, 3});               // 10
    b.addIntegers("SCALAR", 5121, {0, 1});       // 11
    b.addIntegers("SCALAR", 5121, {7, 6, 5});    // 12: too few
    b.addIntegers("SCALAR", 5121, {7, 6, 5, 4}); // 13
    b.meshes = replaced(b.meshes, R"("mode":4)", R"("extensions":{)" + extensions + "}");
    b.more += required.empty() ? "" : R"(,"extensionsRequired":[")" + required + R"("])";
    return b;
}

TEST(GltfLeftOut, AMalformedCageExtensionAlone) {
    const std::string element = "mesh 0 primitive 0 SUPPLE_mesh_cage";
    const Character none = readWell(extendedQuad(R"("SUPPLE_mesh_cage":[])"));
    EXPECT_EQ(none.cage.faceCount(), 2u);
    EXPECT_EQ(none.warnings, (Strings{element + ": not an object; left out"}));
    // One list that cannot be used does not take the others along.
    const std::string corners = R"(,"cornerIndices":11,"cornerSharpnesses":10)";
    for (const std::string creases :
         {R"("creaseIndices":9,"creaseSharpnesses":10)", R"("creaseIndices":11,"creaseSharpnesses":10)"}) {
        SCOPED_TRACE(creases);
        const Character c = readWell(extendedQuad(R"("SUPPLE_mesh_cage":{)" + creases + corners + "}"));
        EXPECT_EQ(c.cage.faceCount(), 2u);
        EXPECT_TRUE(c.cage.creases.empty());
        EXPECT_EQ(c.cage.sharpVertices.size(), 2u);
        EXPECT_EQ(c.warnings.size(), 1u);
    }
    // With the numbers of cage vertices goes what names vertices by them.
    const Character numbers = readWell(extendedQuad(R"("SUPPLE_mesh_cage":{"cageVertices":12)" + corners + "}"));
    EXPECT_EQ(numbers.cage.faceCount(), 2u);
    EXPECT_EQ(numbers.parts[0].weldSource, WeldSource::equality);
    EXPECT_TRUE(numbers.cage.sharpVertices.empty());
    EXPECT_EQ(numbers.warnings, (Strings{element + " cageVertices: 3 elements for 4 vertices; left out"}));
}

TEST(GltfLeftOut, NumbersThatOnePrimitiveLacks) {
    GltfBuilder b = extendedQuad(R"("SUPPLE_mesh_cage":{"cageVertices":13,"cornerIndices":11,"cornerSharpnesses":10})");
    b.meshes = replaced(b.meshes, "]}]", R"(,{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3}]}])");
    const Character c = readWell(b);
    EXPECT_GE(c.cage.faceCount(), 2u);
    EXPECT_EQ(c.parts[0].weldSource, WeldSource::equality);
    EXPECT_TRUE(c.cage.sharpVertices.empty());
}

TEST(GltfLeftOut, PolygonsThatTheFileRequiresAreNot) {
    EXPECT_EQ(
        saidOf(extendedQuad(R"("EXT_mesh_polygon":{})", "EXT_mesh_polygon").glb()),
        "refused: t.glb: mesh 0 primitive 0 EXT_mesh_polygon: a form of the draft that is not understood, without "
        "count");
    GltfBuilder strip = extendedQuad(R"("EXT_mesh_polygon":{})", "EXT_mesh_polygon");
    strip.meshes = replaced(strip.meshes, R"("indices":3,)", R"("indices":3,"mode":5,)");
    EXPECT_EQ(saidOf(strip.glb()), "refused: t.glb: mesh 0 primitive 0 EXT_mesh_polygon: TRIANGLE_STRIP instead of "
                                   "TRIANGLES");
    EXPECT_TRUE(saidOf(extendedQuad(R"("EXT_mesh_polygon":{})").glb()).ends_with("without count; not used"));
}

TEST(GltfLeftOut, ABufferViewAlone) {
    const auto withView = [](const std::vector<std::byte>& glb, size_t view, const char* key) {
        return changed(glb, [&](nlohmann::json& root) {
            nlohmann::json& object = root["bufferViews"][view];
            (object.contains("extensions") ? object["extensions"]["EXT_meshopt_compression"] : object)[key] = 7;
        });
    };
    const Character c = readWell(withView(skinnedQuad().glb(), kUvs, "buffer"));
    EXPECT_EQ(c.cage.faceCount(), 2u);
    EXPECT_TRUE(c.cage.cornerUvs.empty());
    EXPECT_EQ(c.warnings.at(0), "bufferView 8 buffer: buffer 7 is out of range: the file has 1; left out");

    GltfBuilder b;
    std::vector<float> positions, uvs;
    for (int v = 0; v < 300; ++v) {
        positions.insert(positions.end(), {static_cast<float>(v), static_cast<float>(v % 3), 0.0f});
        uvs.insert(uvs.end(), {0.0f, 0.5f});
    }
    b.addFloats("VEC3", positions);
    b.addFloats("VEC2", uvs);
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1}}]}])";
    const std::vector<std::byte> good = compressed(b, "EXT_meshopt_compression");
    EXPECT_FALSE(readWell(good).cage.cornerUvs.empty());
    for (const char* key : {"buffer", "mode"}) {
        const Character left = readWell(withView(good, 1, key));
        EXPECT_EQ(left.cage.faceCount(), 100u);
        EXPECT_TRUE(left.cage.cornerUvs.empty());
    }
    std::vector<std::byte> damaged = good;
    const nlohmann::json root = jsonOf(good);
    const auto& view = root["bufferViews"][1]["extensions"]["EXT_meshopt_compression"];
    damaged[binaryOffset(good) + view["byteOffset"].get<size_t>()] = std::byte{0xB0};
    EXPECT_EQ(readWell(damaged).cage.faceCount(), 100u);
    EXPECT_TRUE(readWell(damaged).cage.cornerUvs.empty());
}

TEST(GltfLeftOut, AChannelThatCannotBeReadTakesNoOthersPlace) {
    const std::string first = R"({"sampler":0,"target":{"node":2,"path":"rotation"}})";
    const std::string translation = R"({"sampler":0,"target":{"node":2,"path":"translation"}})";
    GltfBuilder b = skinnedQuad();
    const Character c = readWell(packGlb(replaced(b.json(), first, translation), b.binary()));
    ASSERT_EQ(c.clips[0].channels.size(), 1u);
    EXPECT_EQ(c.clips[0].channels[0].path, ChannelPath::translation);
    EXPECT_EQ(c.warnings, (Strings{"animation 0 channel 0 output: VEC4 instead of VEC3; left out"}));
    // Nor does it take a matrix apart.
    b.nodes = R"([{"mesh":0,"skin":0},{"children":[2]},{"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,1,0,0,1]}])";
    b.more = replaced(b.more, "," + std::string(R"({"sampler":1,"target":{"node":2,"path":"translation"}})"), "");
    EXPECT_TRUE(readWell(packGlb(replaced(b.json(), first, translation), b.binary())).skeleton.nodes[2].hasMatrix);
}

TEST(GltfLeftOut, AStrictReadingTellsAllFaultsOfNodes) {
    GltfBuilder b = skinnedQuad();
    b.nodes = R"([{"mesh":0,"skin":0},{"children":[2,2,1],"scale":[1e30,1,1]},{"translation":[1e30,0,0]}])";
    EXPECT_EQ(messageOf(b), "t.glb: node 2: listed twice by its parent, node 1\nt.glb: node 1: is its own child");
    b.nodes = replaced(b.nodes, "[2,2,1]", "[2]");
    const std::string both = messageOf(b);
    EXPECT_NE(both.find("node 1 scale: "), std::string::npos) << both;
    EXPECT_NE(both.find("node 2 translation: "), std::string::npos) << both;
}

TEST(GltfLeftOut, RepeatedFaultsCountOnce) {
    Leniency leniency(false);
    const auto fault = [&] { return leniency.leaveOut([] { refuse("mesh 0 primitive 0", "torn"); }); };
    for (int node = 0; node < 5000; ++node) {
        EXPECT_FALSE(fault());
    }
    EXPECT_EQ(leniency.takeDamages().size(), 1u);
    // But not for ever: each of them takes time.
    ErrorCode code = ErrorCode::asset;
    try {
        for (int i = 0; i < 1 << 21; ++i) {
            leniency.mend("mesh 0 primitive 0", "torn", "mended");
        }
    } catch (const Refusal& refusal) {
        code = refusal.code;
    }
    EXPECT_EQ(code, ErrorCode::limit);
}

} // namespace
} // namespace supple::cage
