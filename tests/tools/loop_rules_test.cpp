// supple bake --scheme fragments --rules loop: the surface of --scheme loop, refined.
#include "tests/support/meshes.h"
#include "tests/tools/baked_files.h"
#include "tests/tools/command_runner.h"

#include <algorithm>

namespace supple::test {
namespace {

std::string trianglesOf(const cage::Cage& cage) {
    std::ostringstream obj;
    for (const glm::vec3& p : cage.positions) {
        obj << "v " << p.x << " " << p.y << " " << p.z << "\n";
    }
    for (uint32_t c = 0; c < cage.cornerCount(); c += 3) {
        obj << "f";
        for (uint32_t k = c; k < c + 3; ++k) {
            obj << " " << cage.faceVertices[k] + 1;
        }
        obj << "\n";
    }
    return obj.str();
}

/// How far the points of one list are from the nearest of another, at most.
float farthest(const std::vector<glm::vec3>& points, const std::vector<glm::vec3>& others) {
    float most = 0.0f;
    for (const glm::vec3& p : points) {
        float least = 1e30f;
        for (const glm::vec3& q : others) {
            least = std::min(least, glm::distance(p, q));
        }
        most = std::max(most, least);
    }
    return most;
}

using LoopRules = CommandTest;

TEST_F(LoopRules, FragmentsAreTheSurfaceOfLoop) {
    writeText(file("t.obj"), trianglesOf(gyroBipyramid(5)));
    const auto bake = [&](const std::string& options) {
        const Outcome baked = runOnDevice("bake t.obj -o out.ply --rate 8 --scheme " + options);
        EXPECT_EQ(baked.exitCode, 0) << baked.err;
        return readPly(file("out.ply"));
    };
    const Ply loop = bake("loop"), byLoop = bake("fragments --rules loop"), byDefault = bake("fragments");
    ASSERT_EQ(loop.positions.size(), byLoop.positions.size());
    EXPECT_EQ(loop.faces.size(), byLoop.faces.size());
    EXPECT_LT(farthest(byLoop.positions, loop.positions), 2e-6f);
    EXPECT_LT(farthest(loop.positions, byLoop.positions), 2e-6f);
    EXPECT_GT(farthest(byDefault.positions, loop.positions), 1e-2f) << "Catmull-Clark's is another surface";
}

TEST_F(LoopRules, AreNamedWrongly) {
    writeText(file("cube.obj"), kCubeObj);
    const Outcome outcome = run("bake cube.obj -o out.ply --scheme fragments --rules butterfly");
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_NE(outcome.err.find("--rules"), std::string::npos) << outcome.err;
}

} // namespace
} // namespace supple::test
