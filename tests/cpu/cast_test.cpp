// Rays against the surfaces of cages and of a character, beside triangles that are far denser.
#include "tests/support/dense_triangles.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/read_character.h"
#include "tests/support/sample_assets.h"
#include "tests/support/worst.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>

namespace supple::test {
namespace {

constexpr SuppleScheme kCastSchemes[] = {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM,    SUPPLE_SCHEME_CATMULL_CLARK,
                                         SUPPLE_SCHEME_LOOP, SUPPLE_SCHEME_BLEND, SUPPLE_SCHEME_POLYGONS,
                                         SUPPLE_SCHEME_CAGE};
/// Rays that graze the surface may give the farther of two points: so many of all.
constexpr double kMostWrong = 0.002;

/// What rays find, against the triangles. Returns how many miss something nearer. What is found in front of the
/// triangles is right: it lies on the surface and on the ray, and triangles cut corners.
uint32_t wrongOf(const Surfaces& surfaces, const std::vector<glm::vec3>& cage, uint32_t count, double& beside) {
    const DenseTriangles dense(surfaces, cage);
    const std::vector<TestRay> rays = raysAt(dense, surfaces, cage, count);
    SupplePointQuery query = queryOf(SUPPLE_FIND_RAY, rays.size(), &rays[0].origin.x);
    query.cage = &cage[0].x;
    query.cageVertexCount = static_cast<uint32_t>(cage.size());
    std::vector<SuppleSurfaceJet> jets(rays.size());
    query.jets = jets.data();
    const std::vector<SuppleSurfacePoint> hits = found(surfaces, query);
    uint32_t wrong = 0, hit = 0;
    for (size_t k = 0; k < rays.size(); ++k) {
        const double expected = dense.first(rays[k]);
        double t = std::numeric_limits<double>::max();
        if (hits[k].face != SUPPLE_NO_FACE) {
            const glm::dvec3 e = glm::dvec3(jets[k].position[0], jets[k].position[1], jets[k].position[2]) -
                                 glm::dvec3(rays[k].origin),
                             d(rays[k].direction);
            t = glm::dot(e, d) / glm::dot(d, d);
            EXPECT_GT(t, 0.0);
            raise(beside, glm::length(e - t * d) / dense.extent);
            ++hit;
        }
        const double length = glm::length(rays[k].direction);
        wrong += (t - expected) * length > 0.01 * dense.extent ? 1 : 0;
    }
    EXPECT_GT(hit, count / 3);
    return wrong;
}

TEST(Cast, RaysMeetWhatDenseTrianglesDo) {
    constexpr uint32_t kRays = 300;
    uint32_t wrong = 0, all = 0;
    double beside = 0.0;
    for (const cage::Cage& cage : {perturbed(cage::makeSplitTorus(8, 6), 0.02f, 3),
                                   perturbed(cage::makeCubeSphere(3), 0.05f, 5), fanOverPentagons(6)}) {
        for (const SuppleScheme scheme : kCastSchemes) {
            if (scheme == SUPPLE_SCHEME_PREP && cage.sides(0) != 4) {
                continue; // it takes quads
            }
            const Surfaces surfaces = surfacesOf(cage, scheme);
            ASSERT_NE(surfaces, nullptr);
            const uint32_t own = wrongOf(surfaces, cage.positions, kRays, beside);
            std::printf("scheme %u, %u faces: %u of %u rays wrong\n", scheme, cage.faceCount(), own, kRays);
            wrong += own;
            all += kRays;
        }
    }
    std::printf("%u of %u wrong; hits up to %.1e of the extent beside their rays\n", wrong, all, beside);
    EXPECT_LE(wrong, kMostWrong * all);
    EXPECT_LE(beside, 3e-7);
}

/// The character of the samples, bent at its middle.
TEST(Cast, RaysMeetABentCharacter) {
    cage::Character character = readCharacter(kPipQuads);
    std::vector<glm::vec3> bent = character.cage.positions;
    ASSERT_FALSE(bent.empty());
    for (glm::vec3& p : bent) {
        p = glm::vec3(glm::rotate(glm::mat4(1.0f), 0.8f * p.y, glm::vec3(0, 0, 1)) * glm::vec4(p, 1.0f));
    }
    const auto prepared = runtime::Prepared::of(std::move(character));
    uint32_t wrong = 0, all = 0;
    double beside = 0.0;
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK}) {
        SuppleGroupDesc desc{};
        desc.structSize = sizeof(desc);
        desc.scheme = scheme;
        const auto surfaces = runtime::surfacesOf(prepared, desc);
        ASSERT_TRUE(surfaces.ok());
        constexpr uint32_t kRays = 1500;
        const uint32_t own = wrongOf(*surfaces, bent, kRays, beside);
        std::printf("scheme %u: %u of %u rays wrong\n", scheme, own, kRays);
        wrong += own;
        all += kRays;
    }
    std::printf("hits up to %.1e of the extent beside their rays\n", beside);
    EXPECT_LE(wrong, kMostWrong * all);
    EXPECT_LE(beside, 3e-7);
}

/// Rays that begin inside, behind or on the surface, that run along an edge, and that miss.
TEST(Cast, OfTheHitsInFrontTheFirstIsTaken) {
    cage::Cage boxes; // two unit squares, at z = 0 and z = 2
    boxes.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}};
    boxes.faceStarts = {0, 4, 8};
    boxes.faceVertices = {0, 1, 2, 3, 4, 5, 6, 7};
    const Surfaces surfaces = surfacesOf(boxes, SUPPLE_SCHEME_CAGE);
    const TestRay rays[] = {
        {{0.25f, 0.5f, 5}, {0, 0, -1}},  {{0.25f, 0.5f, 1}, {0, 0, -3}},     {{0.25f, 0.5f, 1}, {0, 0, 2}},
        {{0.25f, 0.5f, -1}, {0, 0, -1}}, {{0.25f, 0.5f, 5}, {0, 0, 1}},      {{2, 0.5f, 5}, {0, 0, -1}},
        {{0, 0, 5}, {0, 0, -1}},         {{1, 0.5f, 5}, {0, 0, -1}},         {{0.5f, 0.5f, 0}, {0, 0, -1}},
        {{-1, 0.5f, 0}, {1, 0, 0}},      {{0.25f, 0.5f, 5}, {0, 0, -1e-30f}}};
    const uint32_t expected[] = {1, 0, 1, SUPPLE_NO_FACE, SUPPLE_NO_FACE, SUPPLE_NO_FACE, 1, 1, 0, SUPPLE_NO_FACE, 1};
    const auto hits = found(surfaces, queryOf(SUPPLE_FIND_RAY, std::size(rays), &rays[0].origin.x));
    for (size_t k = 0; k < std::size(rays); ++k) {
        EXPECT_EQ(hits[k].face, expected[k]) << k;
    }
    EXPECT_EQ(hits[0].a, 0.25f);
    EXPECT_EQ(hits[0].b, 0.5f);
}

/// Jets are those of the points, in the cage that was searched; zeros where there is no point.
TEST(Cast, JetsAreThoseOfThePoints) {
    const cage::Cage cage = perturbed(cage::makeCubeSphere(3), 0.02f, 3);
    const Surfaces surfaces = surfacesOf(cage, SUPPLE_SCHEME_CATMULL_CLARK);
    std::vector<glm::vec3> moved = cage.positions;
    for (glm::vec3& p : moved) {
        p += glm::vec3(3.0f, 0.0f, 0.0f);
    }
    const TestRay rays[] = {{{3.0f, 0.1f, 9.0f}, {0, 0, -1}}, {{0.0f, 0.1f, 9.0f}, {0, 0, -1}}};
    SupplePointQuery query = queryOf(SUPPLE_FIND_RAY, 2, &rays[0].origin.x);
    query.cage = &moved[0].x;
    query.cageVertexCount = static_cast<uint32_t>(moved.size());
    SuppleSurfaceJet jets[2];
    std::memset(jets, 0xFF, sizeof(jets));
    query.jets = jets;
    const auto hits = found(surfaces, query);
    runtime::CpuPose pose(surfaces);
    ASSERT_TRUE(pose.build(reinterpret_cast<const std::byte*>(moved.data()), sizeof(moved[0]), {}));
    SuppleSurfaceJet own;
    ASSERT_TRUE(pose.evaluate({&hits[0], 1}, &own, {}));
    EXPECT_EQ(std::memcmp(&own, &jets[0], sizeof(own)), 0);
    EXPECT_EQ(hits[1].face, SUPPLE_NO_FACE);
    const SuppleSurfaceJet none{};
    EXPECT_EQ(std::memcmp(&none, &jets[1], sizeof(none)), 0);
}

} // namespace
} // namespace supple::test
