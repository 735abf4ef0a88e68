// What supple inspect --compare measures against: points of the limit lie on it, other points as far as they are off.
#include "tools/supple/limit_surface.h"

#include "tests/support/meshes.h"
#include "tools/reference/fragments.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace supple::tools {
namespace {

namespace subdivision = surface::subdivision;

cage::Cage withCrease(cage::Cage cage, const std::vector<std::pair<uint32_t, uint32_t>>& edges, float sharpness) {
    for (const auto& [a, b] : edges) {
        cage.creases.push_back({a, b, sharpness});
    }
    return cage;
}

/// The four edges of a cube's side that faces +z.
cage::Cage creasedCube(float sharpness) {
    cage::Cage cube = test::cube();
    std::vector<std::pair<uint32_t, uint32_t>> edges;
    for (uint32_t face = 0; face < cube.faceCount(); ++face) {
        for (uint32_t i = 0; i < 4; ++i) {
            const uint32_t a = cube.faceVertices[4 * face + i], b = cube.faceVertices[4 * face + (i + 1) % 4];
            if (cube.positions[a].z > 0.0f && cube.positions[b].z > 0.0f && a < b) {
                edges.emplace_back(a, b);
            }
        }
    }
    EXPECT_EQ(edges.size(), 4u);
    return withCrease(std::move(cube), edges, sharpness);
}

LimitSurface limitOf(const cage::Cage& cage) {
    Result<LimitSurface> limit = LimitSurface::build(cage, test::doublePositions(cage));
    EXPECT_TRUE(limit.ok()) << (limit.ok() ? "" : limit.error().message);
    return std::move(*limit);
}

/// Calls visit(face, sample) for points of the limit, most of which LimitSurface has not kept.
template <class Visit>
void forEachLimitPoint(const cage::Cage& cage, Visit&& visit) {
    const Result<subdivision::Mesh> mesh = subdivision::buildMesh(cage, subdivision::Subdivision::catmullClark);
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    const std::vector<glm::dvec3> positions = test::doublePositions(cage);
    const auto isolated = subdivision::isolate<double>(*mesh, positions);
    subdivision::forEachSector<double>(*mesh, isolated, 6, [&](const subdivision::SectorGrid<double>& grid) {
        for (size_t i = 0; i < grid.samples.size(); i += 7) {
            visit(mesh->sourceFaces[grid.face], grid.samples[i]);
        }
    });
}

TEST(LimitSurface, pointsOfTheLimitLieOnIt) {
    const std::vector<std::pair<std::string, cage::Cage>> cages = {
        {"cube", test::cube()},
        {"biped", test::biped()},
        {"dodecahedron", test::dodecahedron()},
        {"trapezohedron 12", test::trapezohedron(12)},
        {"open grid", test::grid(4, 3)},
        {"capped cylinder", test::cappedCylinder(9, 4)},
        {"cube, hard crease", creasedCube(cage::kHardSharpness)},
        {"cube, crease of 1.5", creasedCube(1.5f)},
        {"cube, crease of 3", creasedCube(3.0f)}};
    for (const auto& [name, cage] : cages) {
        SCOPED_TRACE(name);
        const LimitSurface limit = limitOf(cage);
        LimitSurface::Probe probe(limit);
        const double extent = test::extent(test::doublePositions(cage));
        double farthest = 0.0, steepest = 0.0, doubt = 0.0;
        forEachLimitPoint(cage, [&](uint32_t face, const subdivision::Sample<double>& sample) {
            const LimitSurface::Deviation deviation = probe.measure(face, sample.position, sample.normal, true);
            doubt = std::max(doubt, deviation.doubt);
            farthest = std::max(farthest, deviation.distance);
            steepest = std::max(steepest, deviation.degrees);
        });
        std::printf("%-20s measured %.1e of the extent off, %.3f degrees; doubt %.1e\n", name.c_str(),
                    farthest / extent, steepest, doubt / extent);
        EXPECT_LE(farthest, doubt + 1e-14 * extent) << "the estimate is a cautious one";
        EXPECT_LT(farthest, 1e-6 * extent);
        EXPECT_LT(steepest, 0.1);
    }
}

TEST(LimitSurface, pointsOffTheLimitAreAsFarAsTheyAre) {
    const cage::Cage torus = test::torus(12, 8);
    const LimitSurface limit = limitOf(torus);
    LimitSurface::Probe probe(limit);
    for (const double offset : {1e-6, 1e-3, -1e-2, 5e-2}) {
        double farthest = 0.0;
        forEachLimitPoint(torus, [&](uint32_t face, const subdivision::Sample<double>& sample) {
            const auto deviation = probe.measure(face, sample.position + offset * sample.normal, sample.normal);
            farthest = std::max(farthest, std::abs(deviation.distance - std::abs(offset)));
            EXPECT_LT(deviation.degrees, 1e-3);
        });
        EXPECT_LT(farthest, 1e-9) << "offset " << offset;
    }
}

/// Both sides of a hard crease have their own normals there, and each is compared with its own.
TEST(LimitSurface, normalsOfHardCreasesAreThoseOfTheFacesSide) {
    const cage::Cage cube = creasedCube(cage::kHardSharpness);
    const LimitSurface limit = limitOf(cube);
    LimitSurface::Probe probe(limit);
    uint32_t onCrease = 0;
    forEachLimitPoint(cube, [&](uint32_t face, const subdivision::Sample<double>& sample) {
        bool top = true;
        for (uint32_t i = 0; i < 4; ++i) {
            top = top && cube.positions[cube.faceVertices[4 * face + i]].z > 0.0f;
        }
        if (!top || sample.position.z < 1.0 - 1e-12) {
            return;
        }
        ++onCrease;
        const glm::dvec3 up(0.0, 0.0, 1.0);
        EXPECT_LT(probe.measure(face, sample.position, up).degrees, 1e-3) << "the side on top is flat";
        // Moved beyond the crease, the point is nearest to the other side; the normal stays that of its own.
        const auto beyond = probe.measure(face, sample.position * 1.001, up);
        EXPECT_LT(beyond.degrees, 1e-3);
    });
    EXPECT_GT(onCrease, 100u);
}

TEST(LimitSurface, refusesWhatIsNoSurface) {
    cage::Cage fin =
        test::makeCage({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
    const Result<LimitSurface> limit = LimitSurface::build(fin, test::doublePositions(fin));
    ASSERT_FALSE(limit.ok());
    EXPECT_NE(limit.error().message.find("edge (0, 1)"), std::string::npos) << limit.error().message;

    cage::Cage gone = test::grid(1, 1);
    gone.holes = {0};
    EXPECT_FALSE(LimitSurface::build(gone, test::doublePositions(gone)).ok());
}

} // namespace
} // namespace supple::tools
