// What two faces have in common must come out with the same bits from both, in float, as on the device.
#include "tests/support/blend_surface.h"
#include "tests/support/kernel_zoo.h"
#include "tests/support/pm_zoo.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <map>

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
    uint64_t points = 0, differ = 0;
    double error = 0.0; ///< against double, by the extent
};

void compare(const cage::Cage& cage, const Mesh& mesh, Counts& counts) {
    const std::vector<glm::dvec3> positions = test::doublePositions(cage);
    const BlendSurface<float> surface(mesh, cage.positions);
    const BlendSurface<double> exact(mesh, positions);
    for (const uint32_t rate : {1u, 2u, 3u, 8u, 17u}) {
        const Evaluator<float> evaluator = surface.at(rate);
        const uint32_t side = rate + 1;
        std::vector<glm::vec3> points; // face by face
        for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
            for (uint32_t sample = 0; sample < side * side; ++sample) {
                points.push_back(evaluator.at(f, sample % side, sample / side).position);
            }
        }
        const auto at = [&](uint32_t corner, uint32_t k) {
            const auto [i, j] = test::onEdge(corner, k, rate);
            return points[(corner / 4 * side + j) * side + i];
        };
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
        if (rate == 8) {
            const Evaluator<double> reference = exact.at(rate);
            const double extent = test::extent(positions);
            for (uint32_t n = 0; n < points.size(); ++n) {
                const uint32_t sample = n % (side * side);
                const glm::dvec3 p = reference.at(n / (side * side), sample % side, sample / side).position;
                counts.error = std::max(counts.error, glm::distance(p, glm::dvec3(points[n])) / extent);
            }
        }
    }
}

void report(const char* zoo, CreaseMode mode, const Counts& counts) {
    std::printf("%-10s %-5s %llu shared points, %llu differ; float against double %.1e of the extent\n", zoo,
                mode == CreaseMode::cut ? "cut" : "curve", static_cast<unsigned long long>(counts.points),
                static_cast<unsigned long long>(counts.differ), counts.error);
    EXPECT_EQ(counts.differ, 0u);
    EXPECT_LT(counts.error, 1e-6);
}

TEST(BlendBits, sharedPointsAgree) {
    for (const CreaseMode mode : test::kCreaseModes) {
        Counts kernel, pm;
        for (const test::KernelCage& entry : test::kernelZoo()) {
            compare(entry.cage, test::blendMesh(entry.cage, {mode}), kernel);
        }
        for (const test::PmCage& entry : test::pmZoo()) {
            if (entry.variant == test::PmVariant::plain || entry.variant == test::PmVariant::alphas) {
                continue; // moved ones of the same connectivity are there
            }
            compare(entry.cage, test::blendMesh(entry.cage, {mode}), pm);
        }
        report("kernel zoo", mode, kernel);
        report("P_m zoo", mode, pm);
    }
}

} // namespace
} // namespace supple::surface::blend
