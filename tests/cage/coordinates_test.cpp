// Coordinates that are finite, but too large for normals to be.
#include "cage/formats/reader.h"
#include "cage/limits.h"
#include "tests/cage/gltf/reading.h"

#include <gtest/gtest.h>

namespace supple::test {
namespace {

TEST(Coordinates, ThoseBeyondTheLimitAreRefusedByName) {
    const auto spoiled = [](int accessor, size_t component, float value) {
        GltfBuilder b = skinnedQuad();
        b.setFloat(accessor, component, value);
        return messageOf(b.glb());
    };
    EXPECT_EQ(spoiled(kPositions, 4, 3e38f), "t.glb: mesh 0 primitive 0 POSITION[1]: beyond 1e+09");
    EXPECT_EQ(spoiled(kPositions, 4, -1.1e9f), "t.glb: mesh 0 primitive 0 POSITION[1]: beyond 1e+09");
    EXPECT_EQ(spoiled(kPositions, 4, cage::kMaxCoordinate), "accepted");
    EXPECT_EQ(spoiled(kTranslations, 4, 3e38f), "t.glb: animation 0 channel 1 output[1]: beyond 1e+09");
    EXPECT_EQ(spoiled(kInverseBinds, 12, 3e38f), "t.glb: skin 0 inverseBindMatrices[0]: beyond 1e+09");

    const auto withNode = [](const std::string& placing) {
        GltfBuilder b = skinnedQuad();
        b.nodes = replaced(b.nodes, R"("translation":[1,0,0])", placing);
        return messageOf(b.glb());
    };
    EXPECT_EQ(withNode(R"("translation":[0,2e9,0])"), "t.glb: node 2 translation: beyond 1e+09");
    EXPECT_EQ(withNode(R"("scale":[1,1,3e38])"), "t.glb: node 2 scale: beyond 1e+09");
    EXPECT_EQ(withNode(R"("matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,1e10,1])"), "t.glb: node 2 matrix: beyond 1e+09");

    GltfBuilder morphed = plainMesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}, R"(,"targets":[{"POSITION":2}])");
    morphed.addFloats("VEC3", {0, 0, 0, 0, 3e38f, 0, 0, 0, 0});
    EXPECT_EQ(messageOf(morphed), "t.glb: mesh 0 primitive 0 target 0 POSITION[1]: beyond 1e+09");

    const Result<cage::Character> obj =
        cage::readCharacter(toBytes("v 0 0 0\nv 1 0 0\nv 0 -3e38 0\nf 1 2 3\n"), "a.obj", "");
    ASSERT_FALSE(obj.ok());
    EXPECT_EQ(obj.error().message, "a.obj: line 3: position: beyond 1e+09");
}

} // namespace
} // namespace supple::test
