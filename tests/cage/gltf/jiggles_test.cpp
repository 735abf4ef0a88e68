// What jiggles by SUPPLE_deformers: what is read, and every fault by its name.
#include "tests/cage/gltf/reading.h"

#include <gtest/gtest.h>

namespace supple::cage {
namespace {

using namespace test;

const std::string kJiggle = R"({"weights":"_SUPPLE_JIGGLE_0","frequency":3.5,"damping":0.25,"limit":0.04})";

/// Two triangles of a mesh, in a primitive each. Accessors: 2 of weights 0, 1, 0.5; 3 of others, which are larger in
/// the last; 4 of a number that is none; 5 of two weights; 6 of zeros;
/// 7 of weights that are less than those of 8.
GltfBuilder painted(const std::string& jiggles, const std::string& attributes = R"("_SUPPLE_JIGGLE_0":2)") {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    b.addFloats("VEC3", {0, 1, 0, 1, 0, 0, 1, 1, 0});
    b.addFloats("SCALAR", {0, 1, 0.5f});
    b.addFloats("SCALAR", {0, 1, 0.75f});
    b.addFloats("SCALAR", {0, 1.5f, 0});
    b.addFloats("SCALAR", {0, 1});
    b.addFloats("SCALAR", {0, 0, 0});
    b.addFloats("SCALAR", {0, 0.25f, 0.25f});
    b.addFloats("SCALAR", {0, 0.75f, 0.5f});
    b.meshes = R"([{"extensions":{"SUPPLE_deformers":{"jiggle":)" + jiggles +
               R"(}},"primitives":[{"attributes":{"POSITION":0,)" + attributes +
               R"(}},{"attributes":{"POSITION":1}}]}])";
    b.more = R"(,"extensionsUsed":["SUPPLE_deformers"])";
    return b;
}
GltfBuilder paintedBut(const std::string& from, const std::string& to) {
    return painted("[" + replaced(kJiggle, from, to) + "]");
}

TEST(GltfJiggles, AreReadAsTheyStand) {
    const Character c = readWell(painted("[" + kJiggle + "]"), kStrict);
    ASSERT_EQ(c.jiggles.size(), 1u);
    EXPECT_EQ(c.jiggles[0], (Jiggle{3.5f, 0.25f, 0.04f}));
    ASSERT_EQ(c.weights.jiggles.size(), c.cage.vertexCount());
    for (uint32_t v = 0; v < c.cage.vertexCount(); ++v) {
        const glm::vec3& p = c.cage.positions[v];
        const float weight = p == glm::vec3(1, 0, 0) ? 1.0f : p == glm::vec3(0, 1, 0) ? 0.5f : 0.0f;
        EXPECT_EQ(c.weights.jiggles[v], (weight > 0.0f ? PaintedWeight{0, weight} : PaintedWeight{})) << v;
    }
    EXPECT_EQ(c.warnings, Strings());
    const Character usual = readWell(painted(R"([{"weights":"_SUPPLE_JIGGLE_0"}])"), kStrict);
    EXPECT_EQ(usual.jiggles.at(0), Jiggle());
    EXPECT_TRUE(readWell(painted("[]")).weights.jiggles.empty());
}

TEST(GltfJiggles, AVertexHasTheOneWithMostWeight) {
    const std::string two = "[" + kJiggle + R"(,{"weights":"_FAT","frequency":9}])";
    const Character c = readWell(painted(two, R"("_SUPPLE_JIGGLE_0":2,"_FAT":3)"), kStrict);
    ASSERT_EQ(c.jiggles.size(), 2u);
    for (uint32_t v = 0; v < c.cage.vertexCount(); ++v) {
        const glm::vec3& p = c.cage.positions[v];
        if (p == glm::vec3(1, 0, 0)) {
            EXPECT_EQ(c.weights.jiggles[v], (PaintedWeight{0, 1.0f})) << "of equal ones the first";
        }
        if (p == glm::vec3(0, 1, 0)) {
            EXPECT_EQ(c.weights.jiggles[v], (PaintedWeight{1, 0.75f}));
        }
    }
}

TEST(GltfJiggles, OneThatHasTheMostWeightNowhereIsNoFault) {
    const std::string two = R"([{"weights":"_THIN"},{"weights":"_FAT","frequency":9}])";
    const Character c = readWell(painted(two, R"("_THIN":7,"_FAT":8)"), kStrict);
    ASSERT_EQ(c.jiggles.size(), 1u) << "and no vertex has it";
    EXPECT_EQ(c.jiggles[0].frequency, 9.0f);
    EXPECT_EQ(c.warnings, Strings());
    const Character equal =
        readWell(painted(R"([{"weights":"_A","frequency":9},{"weights":"_B"}])", R"("_A":2,"_B":2)"), kStrict);
    ASSERT_EQ(equal.jiggles.size(), 1u);
    EXPECT_EQ(equal.jiggles[0].frequency, 9.0f) << "of equal ones the first";
}

TEST(GltfJiggles, FaultsAreNamed) {
    const std::string place = "t.glb: mesh 0 SUPPLE_deformers jiggle[0]";
    const auto is = [&](const GltfBuilder& b, const std::string& message) {
        EXPECT_EQ(messageOf(b), message);
        const Character lenient = readWell(b);
        EXPECT_EQ(lenient.jiggles.size(), 0u);
        EXPECT_TRUE(lenient.weights.jiggles.empty());
        EXPECT_GE(lenient.warnings.size(), 1u) << "it is left out alone";
    };
    is(paintedBut(R"("weights":"_SUPPLE_JIGGLE_0",)", ""), place + ": weights is missing");
    is(paintedBut(R"("_SUPPLE_JIGGLE_0")", "7"), place + " weights: not a string");
    is(paintedBut(R"("_SUPPLE_JIGGLE_0")", R"("NORMAL")"),
       place + R"( weights: "NORMAL" is no name of an application's attribute: it has no _)");
    is(paintedBut(R"("_SUPPLE_JIGGLE_0")", R"("_FAT")"), place + R"(: no vertex has a weight of "_FAT")");
    is(painted("[" + kJiggle + "]", R"("_SUPPLE_JIGGLE_0":6)"),
       place + R"(: no vertex has a weight of "_SUPPLE_JIGGLE_0")");
    is(paintedBut(R"("frequency":3.5)", R"("frequency":31)"), place + " frequency: not a number from 0.05 to 30");
    is(paintedBut(R"("damping":0.25)", R"("damping":-1)"), place + " damping: not a number from 0 to 10");
    is(paintedBut(R"("limit":0.04)", R"("limit":0)"), place + " limit: not a number from 1e-06 to 1e+09");
    is(paintedBut(R"("limit":0.04)", R"("limit":"a")"), place + " limit: not a number from 1e-06 to 1e+09");
    is(painted("{}"), "t.glb: mesh 0 SUPPLE_deformers jiggle: not an array");
    is(painted("[7]"), place + ": not an object");
    const std::string weights = "t.glb: mesh 0 primitive 0 _SUPPLE_JIGGLE_0";
    const std::string wrong = messageOf(painted("[" + kJiggle + "]", R"("_SUPPLE_JIGGLE_0":4)"));
    EXPECT_NE(wrong.find(weights + "[1]: not from 0 to 1"), std::string::npos) << wrong;
    const std::string few = messageOf(painted("[" + kJiggle + "]", R"("_SUPPLE_JIGGLE_0":5)"));
    EXPECT_NE(few.find(weights + ": 2 elements for 3 vertices"), std::string::npos) << few;
    const Character twice = readWell(painted("[" + kJiggle + "," + kJiggle + "]"));
    EXPECT_EQ(twice.jiggles.size(), 1u);
    EXPECT_EQ(twice.warnings.size(), 1u);
}

TEST(GltfJiggles, FaultsOfAllAreToldAtOnce) {
    const std::string wrong = replaced(kJiggle, "3.5", "99"), alsoWrong = replaced(kJiggle, "0.25", "99");
    const std::string said = messageOf(painted("[" + wrong + "," + alsoWrong + "]"));
    EXPECT_NE(said.find("jiggle[0] frequency"), std::string::npos) << said;
    EXPECT_NE(said.find("jiggle[1] damping"), std::string::npos) << said;
}

TEST(GltfJiggles, ManyAreBounded) {
    std::string list = "[";
    for (int i = 0; i < 40; ++i) {
        list += std::string(i > 0 ? "," : "") + R"({"weights":"_J)" + std::to_string(i) + R"("})";
    }
    const Character c = readWell(painted(list + "]", R"("_J3":2,"_J20":2)"));
    EXPECT_EQ(c.jiggles.size(), 1u) << "of the first 16, one is painted";
}

} // namespace
} // namespace supple::cage
