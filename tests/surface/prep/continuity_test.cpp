// Continuity over shared borders: G1 in double, the same bits in float.
#include "tests/support/meshes.h"
#include "tests/support/prep_borders.h"
#include "tests/support/prep_vectors.h"
#include "tests/support/shared_assets.h"
#include "tests/support/worst.h"

#include "tools/common/procedural.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace supple::surface::prep {
namespace {

using test::BitResult;
using test::expectG1;
using test::measureBits;
using test::Posed;
using test::PrepSurface;
using test::raise;

std::vector<Posed> vectorCages() {
    std::vector<Posed> all;
    for (const test::PrepVectors& v : test::prepVectors()) {
        all.push_back({v.name, v.cage, v.positions, v.options});
    }
    return all;
}

std::vector<Posed> proceduralCages() {
    std::vector<std::pair<std::string, cage::Cage>> cages{
        {"cube sphere, 1350 quads", cage::makeCubeSphere(15)},
        {"split torus, 1296 quads", cage::makeSplitTorus(18, 12)},
        {"split torus, perturbed", test::perturbed(cage::makeSplitTorus(18, 12), 0.02f, 1)},
        {"trapezohedron 12, perturbed", test::perturbed(test::trapezohedron(12), 0.02f, 2)},
        {"trapezohedron 40", test::trapezohedron(40)},
        {"grid", test::perturbed(test::grid(4, 3), 0.2f, 3)},
        {"strip", test::perturbed(test::grid(5, 1), 0.2f, 4)},
        {"sphere with holes", test::withoutFaces(cage::makeCubeSphere(3), {0, 13, 31, 32, 40})},
    };
    for (const uint32_t m : {2u, 3u, 4u, 5u, 6u}) {
        cages.emplace_back("open fan " + std::to_string(m), test::perturbed(test::fan(m, 2, 0.8 * m, false), 0.05f, m));
    }
    std::vector<Posed> all;
    for (auto& [name, cage] : cages) {
        const std::vector<glm::dvec3> positions = test::doublePositions(cage);
        all.push_back({name, cage, positions, {}});
        all.push_back({name + ", smooth corners, printed lengths",
                       std::move(cage),
                       positions,
                       {TangentMode::printed, CornerRule::smooth}});
    }
    return all;
}

/// The all-quad manifold OBJ files of the shared assets; says how many files there are and which were left out.
std::vector<Posed> assetCages() {
    const std::vector<std::string> paths = test::filesBelow(test::sharedFolder() + "meshes", {".obj"});
    std::vector<Posed> all;
    uint32_t otherPolygons = 0;
    uint32_t refused = 0;
    for (const std::string& path : paths) {
        Result<cage::Character> character = test::readObjFile(path);
        if (!character.ok()) {
            ADD_FAILURE() << character.error().message;
            continue;
        }
        const std::string name = std::filesystem::path(path).filename().string();
        cage::Cage& cage = character->cage;
        if (!test::allQuads(cage)) {
            ++otherPolygons;
            continue;
        }
        const Result<cage::Topology> topology = cage::buildTopology(cage);
        if (!topology.ok()) {
            std::printf("refused: %s: %s\n", name.c_str(), topology.error().message.c_str());
            ++refused;
            continue;
        }
        std::vector<glm::dvec3> positions = test::doublePositions(cage);
        all.push_back({name, std::move(cage), std::move(positions), {}});
    }
    std::printf("%zu OBJ assets: %zu all-quad manifolds, %u with other polygons, %u refused by the topology\n",
                paths.size(), all.size(), otherPolygons, refused);
    return all;
}

TEST(PrepContinuity, g1OnVectorCages) {
    for (const Posed& posed : vectorCages()) {
        expectG1(posed);
    }
}

TEST(PrepContinuity, g1OnProceduralCages) {
    for (const Posed& posed : proceduralCages()) {
        expectG1(posed);
    }
}

TEST(PrepContinuity, g1OnAssets) {
    const std::vector<Posed> cages = assetCages();
    if (cages.empty()) {
        GTEST_SKIP() << "no OBJ assets: " << test::sharedFolder() << "meshes is not present";
    }
    for (const Posed& posed : cages) {
        expectG1(posed);
    }
}

void expectSameBits(const std::vector<Posed>& cages) {
    uint64_t samples = 0;
    for (const Posed& posed : cages) {
        const std::vector<glm::vec3> positions(posed.positions.begin(), posed.positions.end());
        const BitResult r = measureBits(posed.cage, positions, posed.options);
        EXPECT_EQ(r.different, 0u) << posed.name << ": of " << r.samples << " shared samples";
        samples += r.samples;
    }
    std::printf("%llu shared samples compared\n", static_cast<unsigned long long>(samples));
}

TEST(PrepContinuity, sameBitsOnVectorCages) {
    expectSameBits(vectorCages());
}
TEST(PrepContinuity, sameBitsOnProceduralCages) {
    expectSameBits(proceduralCages());
}

TEST(PrepContinuity, sameBitsOnAssets) {
    const std::vector<Posed> cages = assetCages();
    if (cages.empty()) {
        GTEST_SKIP() << "no OBJ assets: " << test::sharedFolder() << "meshes is not present";
    }
    expectSameBits(cages);
}

TEST(PrepContinuity, sameBitsWithNegativeZeros) {
    // A boundary along x = -0 with all else at x < 0: every product of a border sample there is -0. At its irregular
    // vertex the quads are perturbed, further on they are not, and only one side of the edge between adds a
    // perturbation of +0.
    cage::Cage cage = test::fan(3, 3, std::numbers::pi, false);
    for (glm::vec3& p : cage.positions) {
        p = {std::abs(p.y) < 1e-6f ? -0.0f : -p.y, p.x, p.z};
    }
    const BitResult r = measureBits(cage, cage.positions, {});
    EXPECT_GT(r.samples, 0u);
    EXPECT_EQ(r.different, 0u);
}

TEST(PrepContinuity, sameBitsAtRatesWithACommonFraction) {
    const cage::Cage cage = test::perturbed(test::trapezohedron(7), 0.05f, 1);
    const PrepSurface<float> surface(cage, cage.positions);
    for (const cage::Topology::Edge& edge : surface.topology.edges) {
        for (const auto& [coarse, fine] : {std::pair{2u, 8u}, {3u, 9u}, {5u, 40u}, {7u, 63u}}) {
            for (uint32_t k = 0; k <= coarse; ++k) {
                const uint32_t scale = fine / coarse;
                const glm::vec3 a = surface.onEdge(edge.corner, k, coarse).position;
                const glm::vec3 b = surface.onEdge(edge.twin, fine - scale * k, fine).position;
                EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
            }
        }
    }
}

TEST(PrepContinuity, floatNormalsAgreeAcrossEdges) {
    double worst = 0.0;
    for (const Posed& posed : vectorCages()) {
        const std::vector<glm::vec3> positions(posed.positions.begin(), posed.positions.end());
        raise(worst, test::measureFloatNormals(posed.cage, positions, posed.options, 8).worst);
    }
    std::printf("float normals across edges: max %.1e degrees\n", worst);
    EXPECT_LE(worst, 0.05);
}

} // namespace
} // namespace supple::surface::prep
