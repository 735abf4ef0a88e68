// The exact limit surface against stored vectors, against the fragments at their samples, and against its own
// derivatives.
#include "cpu/catmull_clark.h"
#include "tests/support/json_vectors.h"
#include "tests/support/meshes.h"
#include "tests/support/subdivision_surface.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/worst.h"
#include "tools/reference/fragments.h"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <random>

namespace supple::surface::chains {

using catmull_clark::LimitSurface, catmull_clark::Point;
namespace {

using subdivision::Mesh;
using subdivision::Subdivision;
using test::raise;

double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / 3.14159265358979323846;
}

TEST(ExactLimit, HasTheStoredSamples) {
    size_t files = 0;
    for (const std::filesystem::path& path : test::vectorFiles("exact")) {
        const nlohmann::json j = test::parseFile(path);
        const std::vector<glm::dvec3> positions = test::jsonVectors(j.at("vertices"));
        cage::Cage cage = test::makeCage({positions.begin(), positions.end()}, j.at("faces").get<test::Faces>());
        for (const nlohmann::json& crease : j.at("creases")) {
            cage.creases.push_back({crease.at(0), crease.at(1), crease.at(2)});
        }
        for (const nlohmann::json& corner : j.at("corners")) {
            cage.sharpVertices.push_back({corner.at(0), corner.at(1)});
        }
        const Mesh mesh = test::subdivisionMesh(cage, Subdivision::catmullClark);
        const LimitSurface surface(mesh, positions);
        ASSERT_EQ(surface.quadCount(), cage.faceCount());
        const double extent = test::extent(positions);
        double apart = 0.0, degrees = 0.0;
        size_t samples = 0, corners = 0;
        for (const nlohmann::json& sample : j.at("samples")) {
            const auto at = [&](size_t k) { return sample.at(k).get<double>(); };
            const Point point = surface.at(sample.at(0), at(1), at(2));
            raise(apart, glm::distance(point.position, {at(3), at(4), at(5)}) / extent);
            const glm::dvec3 normal(at(6), at(7), at(8));
            if (at(1) == 0.0 && at(2) == 0.0) {
                ++corners; // normals of some level, in the file
            } else if (normal != glm::dvec3(0.0)) {
                raise(degrees, degreesBetween(point.normal, normal));
            }
            ++samples;
        }
        std::printf("%s: %zu samples, %zu at corners; positions %.1e of the extent, normals %.1e degrees\n",
                    path.stem().c_str(), samples, corners, apart, degrees);
        EXPECT_LE(apart, 1e-12);
        EXPECT_LE(degrees, 1e-7);
        EXPECT_GE(samples, 90u);
        ++files;
    }
    EXPECT_EQ(files, 3u);
}

/// Where nothing semi-sharp is left at the fragments' depth both are the limit, but for the tips of darts, which the
/// fragments only come near to.
TEST(ExactLimit, IsThatOfTheFragments) {
    constexpr uint32_t kSteps = 4, kSide = 1u << kSteps, kStride = 7;
    const std::vector<test::SubdivisionCage>& zoos = test::subdivisionZoo();
    for (size_t z = 0; z < zoos.size(); z += zoos[z].name.find("valence") == std::string::npos ? 1 : 5) {
        const test::SubdivisionCage& zoo = zoos[z];
        const Mesh mesh = test::subdivisionMesh(zoo.cage, Subdivision::catmullClark);
        const std::vector<glm::dvec3> positions(zoo.cage.positions.begin(), zoo.cage.positions.end());
        const std::vector<glm::dvec3> isolated = subdivision::isolate<double>(mesh, positions);
        const LimitSurface surface(mesh, positions);
        double worst = 0.0, corners = 0.0;
        for (const subdivision::SectorGrid<double>& grid : subdivision::evaluate<double>(mesh, isolated, kSteps)) {
            for (uint32_t s = 0; s < grid.samples.size(); s += kStride) {
                const double x = s % (kSide + 1) / (2.0 * kSide), y = s / (kSide + 1) / (2.0 * kSide);
                const double at[4][2] = {{x, y}, {1.0 - y, x}, {1.0 - x, 1.0 - y}, {y, 1.0 - x}};
                const double* uv = at[grid.face % 4];
                const Point point = surface.at(grid.face / 4, uv[0], uv[1]);
                raise(s == 0 ? corners : worst, glm::distance(point.position, grid.samples[s].position));
            }
        }
        const double extent = test::extent(positions);
        std::printf("%s: %.1e of the extent, corners %.1e\n", zoo.name.c_str(), worst / extent, corners / extent);
        EXPECT_LE(worst, 1e-12 * extent) << zoo.name;
        EXPECT_LE(corners, 1e-3 * extent) << zoo.name;
    }
}

/// Only inside, and at low valences, does the surface come near enough to its tangent plane before digits run out.
TEST(ExactLimit, HasNormalsAtCorners) {
    size_t cages = 0, darts = 0;
    for (const test::SubdivisionCage& zoo : test::subdivisionZoo()) {
        const bool dart = zoo.name.find("dart of") == 0;
        const auto named = [&](const char* part) { return zoo.name.find(part) != std::string::npos; };
        const bool low = named(", moved") && zoo.name.find_first_of("345") != std::string::npos && !named("open") &&
                         !named("fan") && !named("disk");
        if (!dart && !low) {
            continue;
        }
        const Mesh mesh = test::subdivisionMesh(zoo.cage, Subdivision::catmullClark);
        const std::vector<glm::dvec3> positions(zoo.cage.positions.begin(), zoo.cage.positions.end());
        const LimitSurface surface(mesh, positions);
        double worst = 0.0, apart = 0.0;
        for (uint32_t quad = 0; quad < surface.quadCount(); ++quad) {
            const Point corner = surface.at(quad, 0.0, 0.0), beside = surface.at(quad, 2e-10, 1.5e-10);
            raise(apart, glm::distance(corner.position, beside.position));
            if (corner.normal != glm::dvec3(0.0)) {
                raise(worst, degreesBetween(corner.normal, beside.normal));
            }
        }
        EXPECT_LE(worst, 1.0) << zoo.name;
        EXPECT_LE(apart, 1e-5 * test::extent(positions)) << zoo.name;
        ++cages;
        darts += dart ? 1 : 0;
    }
    EXPECT_GT(cages, 6u);
    EXPECT_GT(darts, 2u);
}

/// Central differences, also across the lines where leaves meet.
TEST(ExactLimit, HasItsDerivatives) {
    const cage::Cage cage = test::perturbed(test::biped(), 0.08f, 3);
    const Mesh mesh = test::subdivisionMesh(cage, Subdivision::catmullClark);
    const std::vector<glm::dvec3> positions(cage.positions.begin(), cage.positions.end());
    const LimitSurface surface(mesh, positions);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> inside(0.02, 0.98);
    double worst = 0.0;
    for (uint32_t quad = 0; quad < surface.quadCount(); ++quad) {
        for (const double v : {inside(random), 0.25, 0.5}) {
            const double u = inside(random), h = 1e-5;
            const Point p = surface.at(quad, u, v);
            const glm::dvec3 du =
                (surface.at(quad, u + h, v).position - surface.at(quad, u - h, v).position) / (2.0 * h);
            const glm::dvec3 dv =
                (surface.at(quad, u, v + h).position - surface.at(quad, u, v - h).position) / (2.0 * h);
            raise(worst, (glm::distance(p.du, du) + glm::distance(p.dv, dv)) / (glm::length(p.du) + glm::length(p.dv)));
            EXPECT_LT(glm::distance(p.normal, glm::normalize(glm::cross(p.du, p.dv))), 1e-12);
        }
    }
    std::printf("derivatives: %.1e\n", worst);
    EXPECT_LT(worst, 1e-7);
}

} // namespace
} // namespace supple::surface::chains
