// What two faces have in common must come out with the same bits from both, in float, as on the device.
#include "tests/support/blend_surface.h"
#include "tests/support/kernel_zoo.h"
#include "tests/support/pm_zoo.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

namespace supple::surface::blend {
namespace {

using test::BlendSurface;

/// Bits, with the two zeros as one: what is 0 may come out as either.
bool same(const glm::vec3& a, const glm::vec3& b) {
    for (int i = 0; i < 3; ++i) {
        if (std::bit_cast<uint32_t>(a[i] + 0.0f) != std::bit_cast<uint32_t>(b[i] + 0.0f)) {
            return false;
        }
    }
    return true;
}

struct Counts {
    uint64_t points = 0, differ = 0; ///< samples on edges from both sides, vertices from every face
};

void compareSides(const cage::Cage& cage, const Mesh& mesh, Counts& counts) {
    const BlendSurface<float> surface(mesh, cage.positions);
    for (const uint32_t rate : {1u, 2u, 3u, 8u, 17u}) {
        const Evaluator<float> evaluator = surface.at(rate);
        std::vector<glm::vec3> points; // half-edge by half-edge
        for (uint32_t c = 0; c < mesh.cage.cornerCount(); ++c) {
            for (uint32_t k = 0; k <= rate; ++k) {
                const auto [i, j] = test::onEdge(c, k, rate);
                points.push_back(evaluator.at(c / 4, i, j).position);
            }
        }
        const auto at = [&](uint32_t corner, uint32_t k) { return points[corner * (rate + 1) + k]; };
        for (const cage::Topology::Edge& edge : mesh.topology.edges) {
            for (uint32_t k = 0; edge.twin != cage::kNone && k <= rate; ++k) {
                ++counts.points;
                counts.differ += same(at(edge.corner, k), at(edge.twin, rate - k)) ? 0 : 1;
            }
        }
        std::map<uint32_t, glm::vec3> vertices;
        for (uint32_t c = 0; c < mesh.cage.cornerCount(); ++c) {
            const auto [first, fresh] = vertices.emplace(mesh.cage.faceVertices[c], at(c, 0));
            ++counts.points;
            counts.differ += same(first->second, at(c, 0)) ? 0 : 1;
        }
    }
}

struct Errors {
    double position = 0.0;            ///< by the extent
    uint64_t normals = 0, turned = 0; ///< and those more than 0.05 degrees from their place
    uint64_t notOfUnitLength = 0;
};

/// Float against double.
void compareFloats(const cage::Cage& cage, const Mesh& mesh, Errors& errors) {
    constexpr uint32_t kRate = 8;
    const std::vector<glm::dvec3> positions = test::doublePositions(cage);
    const BlendSurface<float> surface(mesh, cage.positions);
    const BlendSurface<double> exact(mesh, positions);
    const Evaluator<float> evaluator = surface.at(kRate);
    const Evaluator<double> reference = exact.at(kRate);
    const double extent = test::extent(positions);
    constexpr uint32_t kSide = kRate + 1;
    for (uint32_t n = 0; n < kSide * kSide * mesh.cage.faceCount(); ++n) {
        const uint32_t f = n / (kSide * kSide), i = n % kSide, j = n / kSide % kSide;
        const Sample<float> a = evaluator.at(f, i, j);
        const Sample<double> b = reference.at(f, i, j);
        errors.position = std::max(errors.position, glm::distance(b.position, glm::dvec3(a.position)) / extent);
        const glm::dvec3 normal(a.normal);
        errors.notOfUnitLength += std::abs(glm::length(normal) - 1.0) < 1e-6 ? 0 : 1;
        ++errors.normals;
        errors.turned += glm::distance(normal, b.normal) < 0.05 * std::numbers::pi / 180.0 ? 0 : 1;
    }
}

/// Cages of triangles, quads and others, with creases of all kinds, by name of their zoo.
template <class Visit>
void forEachCage(CreaseMode mode, Visit&& visit) {
    for (const test::KernelCage& entry : test::kernelZoo()) {
        visit(entry.cage, test::blendMesh(entry.cage, {mode}));
    }
    for (const test::PmCage& entry : test::pmZoo()) {
        // Of the others moved ones with the same connectivity are there.
        if (entry.variant != test::PmVariant::plain && entry.variant != test::PmVariant::alphas) {
            visit(entry.cage, test::blendMesh(entry.cage, {mode}));
        }
    }
}

const char* modeName(CreaseMode mode) {
    return mode == CreaseMode::cut ? "cut" : "curve";
}

TEST(BlendBits, sharedPointsAgree) {
    for (const CreaseMode mode : test::kCreaseModes) {
        Counts counts;
        forEachCage(mode, [&](const cage::Cage& cage, const Mesh& mesh) { compareSides(cage, mesh, counts); });
        std::printf("%-5s %llu shared points, %llu differ\n", modeName(mode),
                    static_cast<unsigned long long>(counts.points), static_cast<unsigned long long>(counts.differ));
        EXPECT_GT(counts.points, 1000000u);
        EXPECT_EQ(counts.differ, 0u);
    }
}

TEST(BlendBits, floatsAreNearDoubles) {
    for (const CreaseMode mode : test::kCreaseModes) {
        Errors errors;
        forEachCage(mode, [&](const cage::Cage& cage, const Mesh& mesh) { compareFloats(cage, mesh, errors); });
        std::printf("%-5s positions within %.1e of the extent, %llu of %llu normals off by more than 0.05 degrees\n",
                    modeName(mode), errors.position, static_cast<unsigned long long>(errors.turned),
                    static_cast<unsigned long long>(errors.normals));
        EXPECT_LT(errors.position, 4e-7);
        EXPECT_EQ(errors.notOfUnitLength, 0u);
        EXPECT_LT(static_cast<double>(errors.turned), 1e-4 * static_cast<double>(errors.normals));
    }
}

} // namespace
} // namespace supple::surface::blend
