// P_m against the Catmull-Clark limit surface as OpenSubdiv evaluates it.
#include "tests/support/meshes.h"
#include "tests/support/pm_surface.h"

#include <algorithm>
#include <cstdio>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>
#ifdef SUPPLE_HAS_OPENSUBDIV
#include "cage/gltf/reader.h"
#include "tests/support/catmull_clark_limit.h"
#include "tests/support/shared_assets.h"
#include "tests/support/worst.h"
#endif

namespace supple::surface::pm {
namespace {

#ifndef SUPPLE_HAS_OPENSUBDIV

TEST(PmOpenSubdiv, distanceToTheLimit) {
    GTEST_SKIP() << "built without OpenSubdiv (opensubdiv/far/topologyRefiner.h and the library osdCPU)";
}

#else

using test::CatmullClarkLimit;
using test::PmSurface;

/// Distances as fractions of the bounding box's diagonal, angles in degrees.
struct Figures {
    double max = 0.0, mean = 0.0;
    double normalMax = 0.0, normalMean = 0.0;
};

class Sums {
public:
    void add(double distance, double degrees) {
        test::raise(figures_.max, distance);
        test::raise(figures_.normalMax, degrees);
        figures_.mean += distance;
        figures_.normalMean += degrees;
        ++samples_;
    }
    [[nodiscard]] Figures figures(double size) const {
        const double count = size * static_cast<double>(samples_);
        return {figures_.max / size, figures_.mean / count, figures_.normalMax, figures_.normalMean * size / count};
    }

private:
    Figures figures_;
    uint64_t samples_ = 0;
};

/// From P_m's samples to the nearest points of the limit.
Figures distanceToLimit(const cage::Cage& cage, const std::vector<glm::dvec3>& positions, uint32_t rate) {
    const PmSurface<double> surface(test::pmMesh(cage), positions);
    const CatmullClarkLimit limit(cage, positions);
    Sums sums;
    for (uint32_t f = 0; f < surface.mesh.cage.faceCount(); ++f) {
        for (uint32_t s = 0; s < sampleCount(domainOf(surface.mesh.classes[f]), rate); ++s) {
            const Sample<double> own = surface.at(f, rate, s);
            const CatmullClarkLimit::Point other = limit.nearest(surface.mesh.sourceFaces[f], own.position);
            sums.add(glm::distance(own.position, other.position), test::angleDegrees(own.normal, other.normal()));
        }
    }
    return sums.figures(test::extent(positions));
}

/// What is to be compared: a cage, and its positions where float would round them.
struct Shape {
    cage::Cage cage;
    std::vector<glm::dvec3> positions;

    Shape(cage::Cage given) : cage(std::move(given)), positions(test::doublePositions(cage)) {}
    Shape(test::RefinedCage given) : cage(std::move(given.cage)), positions(std::move(given.positions)) {}
};

test::RefinedCage refined(const cage::Cage& cage) {
    return test::refineCatmullClark(cage, test::doublePositions(cage), true);
}

/// A torus with a crease along its outermost edges.
cage::Cage creasedTorus(float sharpness) {
    constexpr uint32_t kAround = 8, kAcross = 6;
    cage::Cage cage = test::torus(kAround, kAcross);
    for (uint32_t i = 0; i < kAround; ++i) {
        cage.creases.push_back({i * kAcross, (i + 1) % kAround * kAcross, sharpness});
    }
    return cage;
}

/// All edges at the height of the shoulders, on which the head stands.
cage::Cage bipedWithHardNeck() {
    cage::Cage cage = test::biped();
    const Mesh mesh = test::pmMesh(cage);
    for (const cage::Topology::Edge& edge : mesh.topology.edges) {
        const uint32_t a = cage.faceVertices[edge.corner];
        const uint32_t b =
            cage.faceVertices[cage::nextCorner(cage, mesh.topology.cornerFaces[edge.corner], edge.corner)];
        if (cage.positions[a].z == 5.0f && cage.positions[b].z == 5.0f) {
            cage.creases.push_back({a, b, cage::kHardSharpness});
        }
    }
    return cage;
}

void print(const char* name, uint32_t faces, const Figures& f) {
    std::printf("%-24s %5u faces: max %.2e, mean %.2e; normals max %.2f, mean %.3f degrees", name, faces, f.max, f.mean,
                f.normalMax, f.normalMean);
}

TEST(PmOpenSubdiv, distanceToTheLimit) {
    struct Case {
        const char* name;
        Shape shape;
        Figures expected; ///< measured once with another program; normals of 0 were not
    };
    const std::vector<Case> cases = {
        {"torus", test::torus(8, 6), {2e-16, 3e-17, 0.0, 0.0}},
        {"open grid", test::grid(4, 3), {2e-16, 3e-17, 0.0, 0.0}},
        {"cube", test::cube(), {3.3e-3, 1.0e-3, 2.8, 1.3}},
        {"jack", test::jack(), {6.6e-3, 9.2e-4, 9.1, 2.4}},
        {"biped", test::biped(), {2.2e-3, 1.6e-4, 9.0, 0.9}},
        {"biped, refined once", refined(test::biped()), {6.9e-4, 1.3e-5, 7.3, 0.12}},
        {"dodecahedron, refined", refined(test::dodecahedron()), {1.7e-4, 4.1e-5, 0.24, 0.1}},
        {"trapezohedron 8", test::trapezohedron(8), {7.5e-3, 2.2e-3, 5.9, 2.5}},
        {"biped, hard neck", bipedWithHardNeck(), {1.7e-2, 4.5e-4, 0.0, 0.0}},
        {"torus, crease of 0.5", creasedTorus(0.5f), {6e-4, 1.1e-4, 2.8, 0.0}},
        {"torus, crease of 1", creasedTorus(1.0f), {1.6e-3, 2.4e-4, 5.7, 0.0}},
        {"torus, crease of 2", creasedTorus(2.0f), {1.3e-3, 2.6e-4, 8.5, 0.0}},
        {"torus, crease of 4", creasedTorus(4.0f), {1.3e-3, 2.1e-4, 3.2, 0.0}}};
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        const Figures own = distanceToLimit(c.shape.cage, c.shape.positions, 8);
        print(c.name, c.shape.cage.faceCount(), own);
        std::printf(" (expected %.1e, %.1e; %.2f, %.2f)\n", c.expected.max, c.expected.mean, c.expected.normalMax,
                    c.expected.normalMean);
        constexpr double kMargin = 1.15, kRounding = 1e-15;
        EXPECT_LE(own.max, kMargin * c.expected.max + kRounding);
        EXPECT_LE(own.mean, kMargin * c.expected.mean + kRounding);
        if (c.expected.normalMax > 0.0) {
            EXPECT_LE(own.normalMax, kMargin * c.expected.normalMax);
        }
        if (c.expected.normalMean > 0.0) {
            EXPECT_LE(own.normalMean, kMargin * c.expected.normalMean);
        }
    }
}

/// All quads and not, creased and not: to know the figures, which depend on how coarse a character is.
TEST(PmOpenSubdiv, charactersAgainstTheLimit) {
    for (const std::string& path :
         test::sharedAssets({"characters/mh_proxy741.glb", "characters/mh_female1605.glb", "characters/spot.glb",
                             "characters/trex_ngons.glb", "characters/knight.glb", "characters/pawn_creased.glb"})) {
        const Result<cage::Character> character = cage::readGltfFile(path);
        ASSERT_TRUE(character.ok()) << character.error().message;
        const cage::Cage& cage = character->cage;
        const Figures own = distanceToLimit(cage, test::doublePositions(cage), 4);
        const std::string name = std::filesystem::path(path).filename();
        print(name.c_str(), cage.faceCount(), own);
        std::printf("\n");
        EXPECT_GT(own.mean, 0.0) << name;
        EXPECT_LT(own.max, 0.05) << name;
    }
}

#endif

} // namespace
} // namespace supple::surface::pm
