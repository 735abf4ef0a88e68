// The exact limit surface of Loop against the fragments at their samples, and against its own derivatives.
#include "cpu/loop.h"
#include "tests/support/meshes.h"
#include "tests/support/subdivision_surface.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/worst.h"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <random>

namespace supple::surface::loop {
namespace {

using subdivision::Mesh;
using subdivision::Subdivision;
using test::raise;

/// The steps after which nothing semi-sharp is left.
float semiSharpSteps(const cage::Cage& cage) {
    float most = 0.0f;
    for (const cage::Crease& crease : cage.creases) {
        most = std::max(most, crease.sharpness < cage::kHardSharpness ? crease.sharpness : 0.0f);
    }
    return most;
}

double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / 3.14159265358979323846;
}

/// Weights of corners 1 and 2 of the triangle at a sample of one of its children.
glm::dvec2 weightsAt(uint32_t child, double x, double y) {
    const glm::dvec2 corners[3] = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
    const auto halfway = [&](uint32_t a, uint32_t b) { return 0.5 * (corners[a % 3] + corners[b % 3]); };
    const glm::dvec2 own[3] = {child < 3 ? corners[child] : halfway(0, 1),
                               child < 3 ? halfway(child, child + 1) : halfway(1, 2),
                               child < 3 ? halfway(child, child + 2) : halfway(2, 0)};
    return (1.0 - x - y) * own[0] + x * own[1] + y * own[2];
}

/// But for the tips of darts, which the fragments only come near to.
TEST(LoopLimit, IsThatOfTheFragments) {
    constexpr uint32_t kSteps = 4, kSide = 1u << kSteps;
    size_t cages = 0, open = 0, creased = 0, semiSharp = 0;
    double positions = 0.0, normals = 0.0;
    for (const test::SubdivisionCage& zoo : test::subdivisionZoo()) {
        if (semiSharpSteps(zoo.cage) > 1.0f + kSteps) { // after the last step fragments take what is left as endless
            continue;
        }
        const Mesh mesh = test::subdivisionMesh(zoo.cage, Subdivision::loop);
        const std::vector<glm::dvec3> points(zoo.cage.positions.begin(), zoo.cage.positions.end());
        const std::vector<glm::dvec3> isolated = subdivision::isolate<double>(mesh, points);
        const LimitSurface surface(mesh, points);
        double worst = 0.0, corners = 0.0, degrees = 0.0;
        for (const subdivision::SectorGrid<double>& grid : subdivision::evaluate<double>(mesh, isolated, kSteps)) {
            size_t s = 0;
            for (uint32_t b = 0; b <= kSide; ++b) {
                for (uint32_t a = 0; a + b <= kSide; ++a, ++s) {
                    const bool corner = s == 0 && grid.face % 4 < 3;
                    if (!corner && s % 5 != 0) {
                        continue;
                    }
                    const glm::dvec2 at = weightsAt(grid.face % 4, a / double(kSide), b / double(kSide));
                    const Point point = surface.at(grid.face / 4, at.x, at.y);
                    raise(corner ? corners : worst, glm::distance(point.position, grid.samples[s].position));
                    if (!corner && a > 0 && b > 0 && a + b < kSide) {
                        raise(degrees, degreesBetween(point.normal, grid.samples[s].normal));
                    }
                }
            }
        }
        const double extent = test::extent(points);
        EXPECT_LE(worst, 1e-12 * extent) << zoo.name;
        EXPECT_LE(corners, 1e-3 * extent) << zoo.name;
        EXPECT_LE(degrees, 1e-6) << zoo.name;
        raise(positions, worst / extent);
        raise(normals, degrees);
        ++cages;
        open += zoo.name.find("open") != std::string::npos || zoo.name.find("fan") != std::string::npos ? 1 : 0;
        creased += zoo.cage.creases.empty() ? 0 : 1;
        semiSharp += semiSharpSteps(zoo.cage) > 0.0f ? 1 : 0;
    }
    std::printf(
        "%zu cages, %zu open, %zu creased, %zu semi-sharp: positions %.1e of the extent, normals %.1e degrees\n", cages,
        open, creased, semiSharp, positions, normals);
    EXPECT_GT(cages, 20u);
    EXPECT_GT(creased, 5u);
    EXPECT_GT(semiSharp, 5u);
}

/// Central differences, also across the lines where leaves meet.
TEST(LoopLimit, HasItsDerivatives) {
    const cage::Cage cage = test::inTriangles(test::perturbed(test::biped(), 0.08f, 3));
    const Mesh mesh = test::subdivisionMesh(cage, Subdivision::loop);
    const LimitSurface surface(mesh, std::vector<glm::dvec3>(cage.positions.begin(), cage.positions.end()));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> inside(0.02, 0.48);
    double worst = 0.0;
    for (uint32_t triangle = 0; triangle < surface.triangleCount(); ++triangle) {
        for (const double w : {inside(random), 0.25, 0.5}) {
            const double v = inside(random), h = 1e-5;
            const Point p = surface.at(triangle, v, w);
            const glm::dvec3 dv =
                (surface.at(triangle, v + h, w).position - surface.at(triangle, v - h, w).position) / (2.0 * h);
            const glm::dvec3 dw =
                (surface.at(triangle, v, w + h).position - surface.at(triangle, v, w - h).position) / (2.0 * h);
            raise(worst, (glm::distance(p.du, dv) + glm::distance(p.dv, dw)) / (glm::length(p.du) + glm::length(p.dv)));
        }
    }
    std::printf("derivatives: %.1e\n", worst);
    EXPECT_LT(worst, 1e-7);
}

/// Inside, and at valences at which the surface comes near enough to its tangent plane before digits run out.
TEST(LoopLimit, HasNormalsAtCorners) {
    size_t corners = 0;
    for (const test::SubdivisionCage& zoo : test::subdivisionZoo()) {
        if (!zoo.cage.sharpVertices.empty()) {
            continue;
        }
        const Mesh mesh = test::subdivisionMesh(zoo.cage, Subdivision::loop);
        const std::vector<glm::dvec3> points(zoo.cage.positions.begin(), zoo.cage.positions.end());
        const LimitSurface surface(mesh, points);
        double worst = 0.0, apart = 0.0;
        for (uint32_t triangle = 0; triangle < surface.triangleCount(); ++triangle) {
            const uint32_t vertex = mesh.cage.faceVertices[mesh.cage.faceStarts[4 * triangle]];
            const subdivision::Fragment& fragment = mesh.fragments[vertex];
            const Point corner = surface.at(triangle, 0.0, 0.0), beside = surface.at(triangle, 2e-10, 1.5e-10);
            raise(apart, glm::distance(corner.position, beside.position));
            if (!fragment.open && zoo.cage.creases.empty() && fragment.sectors >= 4 && fragment.sectors <= 7) {
                raise(worst, degreesBetween(corner.normal, beside.normal));
                ++corners;
            }
        }
        EXPECT_LE(worst, 1.0) << zoo.name;
        EXPECT_LE(apart, 1e-5 * test::extent(points)) << zoo.name;
    }
    std::printf("%zu corners\n", corners);
    EXPECT_GT(corners, 300u);
}

} // namespace
} // namespace supple::surface::loop
