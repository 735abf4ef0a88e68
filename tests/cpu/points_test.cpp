// Points of faces: they lie where the grid has them, and derivatives are those of the surface.
#include "cage/topology.h"
#include "surface/grid.h"
#include "tests/support/cpu_group.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/prep_surface.h"
#include "tests/support/subdivision_zoo.h"
#include "tools/common/procedural.h"
#include "tools/reference/pm.h"
#include "tools/reference/prep.h"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <random>

namespace supple::test {
namespace {

struct SchemeCage {
    const char* name;
    SuppleScheme scheme;
    cage::Cage cage;
    SuppleFragmentRules rules = SUPPLE_RULES_CATMULL_CLARK;
};

/// Triangles, quads and pentagons; all quads; all triangles.
std::vector<SchemeCage> schemeCages() {
    const cage::Cage quads = perturbed(biped(), 0.05f, 6);
    const cage::Cage mixed = perturbed(fanOverPentagons(6), 0.03f, 2);
    const cage::Cage triangles = perturbed(quartered(gyroBipyramid(5)), 0.02f, 3);
    return {{"p-rep", SUPPLE_SCHEME_PREP, quads},
            {"P_m", SUPPLE_SCHEME_PM, quads},
            {"P_m, mixed faces", SUPPLE_SCHEME_PM, mixed},
            {"P_m, polar", SUPPLE_SCHEME_PM, perturbed(cappedCylinder(7, 4), 0.02f, 5)},
            {"Catmull-Clark", SUPPLE_SCHEME_CATMULL_CLARK, quads},
            {"Catmull-Clark, mixed faces", SUPPLE_SCHEME_CATMULL_CLARK, mixed},
            {"Catmull-Clark, creases", SUPPLE_SCHEME_CATMULL_CLARK, withRandomSharpness(quads, 4)},
            {"Loop", SUPPLE_SCHEME_LOOP, triangles},
            {"Loop, creases", SUPPLE_SCHEME_LOOP, withRandomSharpness(triangles, 4)},
            {"blend", SUPPLE_SCHEME_BLEND, quads},
            {"blend, mixed faces", SUPPLE_SCHEME_BLEND, mixed},
            {"fragments", SUPPLE_SCHEME_FRAGMENTS, mixed},
            {"fragments by Loop's rules", SUPPLE_SCHEME_FRAGMENTS, triangles, SUPPLE_RULES_LOOP}};
}

CpuOptions optionsOf(const SchemeCage& entry) {
    CpuOptions options;
    options.scheme = entry.scheme;
    options.rules = entry.rules;
    return options;
}

/// Well inside a face, and of faces that are split where they have one parameter.
SuppleSurfacePoint innerPoint(const cage::Cage& cage, uint32_t face, std::mt19937& random) {
    const auto number = [&] { return 0.1f + 0.25f * static_cast<float>(random() % 1000) / 1000.0f; };
    const uint32_t sides = cage.sides(face);
    return {face, sides > 4 ? static_cast<uint32_t>(random() % sides) : 0, number(), number()};
}

glm::dvec3 asVector(const float* v) {
    return {v[0], v[1], v[2]};
}

/// Differences over such a step: the error is of its square, and of float's rounding over it.
constexpr float kStep = 1.0f / 256.0f;

struct Differences {
    double first = 0.0, second = 0.0;
};

Differences differencesAt(const CpuGroup& group, const SuppleSurfacePoint& point, double size) {
    std::vector<SuppleSurfacePoint> points{point};
    const float steps[5][2] = {{kStep, 0.0f}, {-kStep, 0.0f}, {0.0f, kStep}, {0.0f, -kStep}, {0.0f, 0.0f}};
    for (const auto& step : steps) {
        points.push_back({point.face, point.side, point.a + step[0], point.b + step[1]});
    }
    const std::vector<SuppleSurfaceJet> jets = group.at(points);
    const double width = 2.0 * kStep;
    const auto slope = [&](const float* ahead, const float* behind) {
        return (asVector(ahead) - asVector(behind)) / width;
    };
    Differences worst;
    const SuppleSurfaceJet& own = jets[0];
    // First derivatives against positions, second ones against first ones.
    raise(worst.first, glm::length(slope(jets[1].position, jets[2].position) - asVector(own.du)) / size);
    raise(worst.first, glm::length(slope(jets[3].position, jets[4].position) - asVector(own.dv)) / size);
    raise(worst.second, glm::length(slope(jets[1].du, jets[2].du) - asVector(own.duu)) / size);
    raise(worst.second, glm::length(slope(jets[1].dv, jets[2].dv) - asVector(own.duv)) / size);
    raise(worst.second, glm::length(slope(jets[3].du, jets[4].du) - asVector(own.duv)) / size);
    raise(worst.second, glm::length(slope(jets[3].dv, jets[4].dv) - asVector(own.dvv)) / size);
    return worst;
}

TEST(CpuPoints, DerivativesAreThoseOfTheSurface) {
    for (const SchemeCage& entry : schemeCages()) {
        CpuGroup group(entry.cage, optionsOf(entry));
        ASSERT_TRUE(group.valid()) << entry.name;
        ASSERT_EQ(group.build(entry.cage.positions), SUPPLE_OK);
        const double size = extent(doublePositions(entry.cage));
        std::mt19937 random(1);
        std::vector<double> first, second;
        for (uint32_t face = 0; face < entry.cage.faceCount(); ++face) {
            for (int k = 0; k < 4; ++k) {
                const Differences d = differencesAt(group, innerPoint(entry.cage, face, random), size);
                first.push_back(d.first);
                second.push_back(d.second);
            }
        }
        // A few differences reach over a border where second derivatives jump: all but these are close.
        std::sort(first.begin(), first.end());
        std::sort(second.begin(), second.end());
        const size_t most = first.size() * 9 / 10;
        std::printf("%-28s du, dv %.1e, second %.1e of the extent; all: %.1e, %.1e\n", entry.name, first[most],
                    second[most], first.back(), second.back());
        EXPECT_LE(first[most], 2e-4) << entry.name;
        EXPECT_LE(second[most], 2e-2) << entry.name;
        EXPECT_LE(first.back(), 1e-2) << entry.name;
    }
}

/// Two faces at an edge name its points differently: the surface has one position there.
TEST(CpuPoints, FacesAgreeOnTheirEdges) {
    for (const SchemeCage& entry : schemeCages()) {
        CpuGroup group(entry.cage, optionsOf(entry));
        ASSERT_TRUE(group.valid()) << entry.name;
        ASSERT_EQ(group.build(entry.cage.positions), SUPPLE_OK);
        const Result<cage::Topology> topology = cage::buildTopology(entry.cage);
        ASSERT_TRUE(topology.ok());
        // At t of the edge behind a corner.
        const auto onEdge = [&](uint32_t corner, float t) {
            const uint32_t face = topology->cornerFaces[corner], side = corner - entry.cage.faceStarts[face];
            const uint32_t sides = entry.cage.sides(face);
            if (sides > 4) {
                return SuppleSurfacePoint{face, side, t, 0.0f};
            }
            const float quads[4][2] = {{t, 0.0f}, {1.0f, t}, {1.0f - t, 1.0f}, {0.0f, 1.0f - t}};
            const float triangles[3][2] = {{t, 0.0f}, {1.0f - t, t}, {0.0f, 1.0f - t}};
            const float* at = sides == 4 ? quads[side] : triangles[side];
            return SuppleSurfacePoint{face, 0, at[0], at[1]};
        };
        std::vector<SuppleSurfacePoint> left, right;
        for (const cage::Topology::Edge& edge : topology->edges) {
            for (const float t : {0.0f, 0.25f, 0.375f, 0.5f, 1.0f}) {
                if (edge.twin != cage::kNone) {
                    left.push_back(onEdge(edge.corner, t));
                    right.push_back(onEdge(edge.twin, 1.0f - t));
                }
            }
        }
        const std::vector<SuppleSurfaceJet> a = group.at(left), b = group.at(right);
        double worst = 0.0;
        for (size_t i = 0; i < a.size(); ++i) {
            raise(worst, glm::distance(asVector(a[i].position), asVector(b[i].position)));
        }
        EXPECT_LE(worst / extent(doublePositions(entry.cage)), 5e-7) << entry.name;
    }
}

/// p-rep against the formulas in double.
TEST(CpuPoints, PRepHasTheReferencesJets) {
    const cage::Cage cage = perturbed(cage::makeSplitTorus(6, 5), 0.02f, 2);
    CpuOptions options;
    options.scheme = SUPPLE_SCHEME_PREP;
    CpuGroup group(cage, options);
    ASSERT_EQ(group.build(cage.positions), SUPPLE_OK);
    const Result<cage::Topology> topology = cage::buildTopology(cage);
    const std::vector<glm::dvec3> positions = doublePositions(cage);
    const auto coefficients = surface::prep::construct<double>(cage, *topology, positions);
    const double size = extent(positions);
    double position = 0.0, first = 0.0, second = 0.0;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const auto patch = surface::prep::gatherPatch<double>(cage, *topology, coefficients, face);
        for (const auto& [u, v] : {std::pair(0.0f, 0.0f), std::pair(0.3f, 0.8f), std::pair(0.9f, 0.2f)}) {
            const surface::SurfaceJet exact = surface::prep::evaluateJet(patch, u, v);
            const SuppleSurfaceJet jet = group.at({{face, 0, u, v}})[0];
            raise(position, glm::distance(asVector(jet.position), exact.position) / size);
            raise(first, glm::distance(asVector(jet.du), exact.du) / size);
            raise(first, glm::distance(asVector(jet.dv), exact.dv) / size);
            raise(second, glm::distance(asVector(jet.duu), exact.duu) / size);
            raise(second, glm::distance(asVector(jet.duv), exact.duv) / size);
            raise(second, glm::distance(asVector(jet.dvv), exact.dvv) / size);
        }
    }
    std::printf("p-rep: positions %.1e, first %.1e, second %.1e of the extent\n", position, first, second);
    EXPECT_LE(position, 3e-7);
    EXPECT_LE(first, 2e-6);
    EXPECT_LE(second, 2e-5);
}

/// Far from the origin nothing changes but the rounding of positions.
TEST(CpuPoints, DerivativesKeepTheirDigitsFarFromTheOrigin) {
    cage::Cage cage = perturbed(cage::makeCubeSphere(4), 0.02f, 1);
    for (glm::vec3& p : cage.positions) { // exactly representable there too
        p = glm::round(p * 256.0f) / 256.0f;
    }
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK}) {
        CpuOptions options;
        options.scheme = scheme;
        CpuGroup group(cage, options);
        std::vector<SuppleSurfacePoint> points;
        for (uint32_t face = 0; face < cage.faceCount(); ++face) {
            points.push_back({face, 0, 0.3f, 0.7f});
        }
        ASSERT_EQ(group.build(cage.positions), SUPPLE_OK);
        const std::vector<SuppleSurfaceJet> near = group.at(points);
        std::vector<glm::vec3> moved = cage.positions;
        for (glm::vec3& p : moved) {
            p += glm::vec3(4096.0f, -8192.0f, 2048.0f);
        }
        ASSERT_EQ(group.build(moved), SUPPLE_OK);
        const std::vector<SuppleSurfaceJet> far = group.at(points);
        for (size_t i = 0; i < points.size(); ++i) {
            EXPECT_LE(glm::distance(asVector(near[i].du), asVector(far[i].du)), 1e-6);
            EXPECT_LE(glm::distance(asVector(near[i].dvv), asVector(far[i].dvv)), 1e-5);
        }
    }
}

/// Derivatives exist and are finite at every corner of every face.
TEST(CpuPoints, CornersHaveFiniteDerivatives) {
    for (const SchemeCage& entry : schemeCages()) {
        CpuGroup group(entry.cage, optionsOf(entry));
        ASSERT_EQ(group.build(entry.cage.positions), SUPPLE_OK);
        std::vector<SuppleSurfacePoint> points;
        for (uint32_t face = 0; face < entry.cage.faceCount(); ++face) {
            const uint32_t sides = entry.cage.sides(face);
            for (uint32_t side = 0; side < (sides > 4 ? sides : 1); ++side) {
                points.push_back({face, side, 0.0f, 0.0f});
                points.push_back({face, side, 1.0f, 0.0f});
                points.push_back({face, side, 0.0f, 1.0f});
            }
            if (sides == 4) {
                points.push_back({face, 0, 1.0f, 1.0f});
            }
        }
        const std::vector<SuppleSurfaceJet> jets = group.at(points);
        size_t parallel = 0;
        for (size_t i = 0; i < jets.size(); ++i) {
            const float* numbers = jets[i].position;
            for (size_t k = 0; k < sizeof(SuppleSurfaceJet) / sizeof(float); ++k) {
                ASSERT_TRUE(std::isfinite(numbers[k])) << entry.name << ": face " << points[i].face;
            }
            parallel += glm::cross(asVector(jets[i].du), asVector(jets[i].dv)) == glm::dvec3(0.0) ? 1 : 0;
        }
        // A face alone between two creases may have none: there du and dv are parallel.
        const bool creased = !entry.cage.creases.empty();
        EXPECT_LE(parallel, creased ? jets.size() / 50 : 0) << entry.name << " of " << jets.size();
    }
}

} // namespace
} // namespace supple::test
