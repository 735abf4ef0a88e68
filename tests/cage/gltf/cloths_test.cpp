// What is cloth by SUPPLE_deformers: what is read, and faults by their names. What is painted is read as jiggles are
// (jiggles_test.cpp).
#include "tests/cage/gltf/reading.h"

#include <gtest/gtest.h>

namespace supple::cage {
namespace {

using namespace test;

const std::string kCloth =
    R"({"weights":"_SUPPLE_CLOTH_0","stretch":1e-6,"bend":0.002,"volume":true,"tether":1.1,"drag":0.2,"air":0.1,)"
    R"("gravity":5,"hitRadius":0.02,"substeps":3,"colliders":[1,0]})";

/// A square of two triangles, painted on its right.
GltfBuilder clothed(const std::string& cloths) {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    b.addFloats("SCALAR", {0, 1, 0.5f});
    b.meshes = R"([{"extensions":{"SUPPLE_deformers":{"cloth":)" + cloths +
               R"(}},"primitives":[{"attributes":{"POSITION":0,"_SUPPLE_CLOTH_0":1}}]}])";
    b.more =
        R"(,"extensionsUsed":["SUPPLE_deformers","VRMC_springBone"],"extensions":{"VRMC_springBone":{"specVersion":"1.0",)"
        R"("colliders":[{"node":0,"shape":{"sphere":{"radius":0.5}}},{"node":0,"shape":{"sphere":{"radius":0.25}}}]}})";
    return b;
}
GltfBuilder clothedBut(const std::string& from, const std::string& to) {
    return clothed("[" + replaced(kCloth, from, to) + "]");
}

TEST(GltfCloths, AreReadAsTheyStand) {
    const Character c = readWell(clothed("[" + kCloth + "]"), kStrict);
    ASSERT_EQ(c.cloths.size(), 1u);
    EXPECT_EQ(c.cloths[0], (Cloth{1e-6f, 1e-6f, 0.002f, true, 1.1f, 0.2f, 0.1f, 5.0f, 0.02f, 3, {1, 0}}))
        << "shear is that of stretch where the file does not say it";
    ASSERT_EQ(c.weights.cloths.size(), c.cage.vertexCount());
    for (uint32_t v = 0; v < c.cage.vertexCount(); ++v) {
        const glm::vec3& p = c.cage.positions[v];
        const float weight = p == glm::vec3(1, 0, 0) ? 1.0f : p == glm::vec3(0, 1, 0) ? 0.5f : 0.0f;
        EXPECT_EQ(c.weights.cloths[v], (weight > 0.0f ? PaintedWeight{0, weight} : PaintedWeight{})) << v;
    }
    EXPECT_EQ(c.warnings, Strings());
    EXPECT_EQ(readWell(clothed(R"([{"weights":"_SUPPLE_CLOTH_0"}])"), kStrict).cloths.at(0), Cloth());
}

TEST(GltfCloths, FaultsAreNamed) {
    const std::string place = "t.glb: mesh 0 SUPPLE_deformers cloth[0]";
    const auto is = [&](const GltfBuilder& b, const std::string& message) {
        EXPECT_EQ(messageOf(b), message);
        const Character lenient = readWell(b);
        EXPECT_EQ(lenient.cloths.size(), 0u);
        EXPECT_TRUE(lenient.weights.cloths.empty());
        EXPECT_GE(lenient.warnings.size(), 1u) << "it is left out alone";
    };
    is(clothedBut("1e-6", "-1"), place + " stretch: not a number from 0 to 1e+03");
    is(clothedBut("0.002", "\"a\""), place + " bend: not a number from 0 to 1e+03");
    is(clothedBut("true", "1"), place + " volume: neither true nor false");
    is(clothedBut("1.1", "0.5"), place + " tether: neither 0 nor 1 or more");
    is(clothedBut("0.2,", "1.5,"), place + " drag: not a number from 0 to 1");
    is(clothedBut("\"substeps\":3", "\"substeps\":9"), place + " substeps: not from 1 to 8");
    is(clothedBut("\"substeps\":3", "\"substeps\":4294967300"), place + " substeps: not from 1 to 8");
    is(clothedBut("[1,0]", "[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]"), place + " colliders: 17, of at most 16");
    is(clothedBut("[1,0]", "7"), place + " colliders: not an array");
}

TEST(GltfCloths, CollidersThatAreNoneAreLeftOut) {
    const GltfBuilder b = clothedBut("[1,0]", "[1,2]");
    EXPECT_EQ(messageOf(b),
              "t.glb: mesh 0 SUPPLE_deformers cloth colliders: 2 is no collider of the file's spring bones");
    EXPECT_EQ(readWell(b).cloths.at(0).colliders, std::vector<uint32_t>{1});
    EXPECT_EQ(readWell(clothedBut("\"air\"", "\"colliders\":[4294967296],\"air\"")).cloths.size(), 1u);
}

} // namespace
} // namespace supple::cage
