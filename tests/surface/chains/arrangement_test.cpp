// The masks of limits at vertices, against the points that steps of subdivision make.
#include "cpu/fragment.h"
#include "surface/chains/arrangement.h"
#include "tests/support/subdivision_surface.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/worst.h"
#include "tools/reference/fragments.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

namespace supple::surface::chains {
namespace {

using subdivision::Fan;
using subdivision::Fragment;
using subdivision::FragmentNet;
using subdivision::Mesh;
using test::raise;

glm::dvec3 weighted(const subdivision::CentreMask& mask, const std::vector<glm::dvec3>& points) {
    glm::dvec3 sum(0.0);
    for (size_t i = 1; i < mask.size(); ++i) {
        sum += mask[i] * (points[i] - points[0]);
    }
    return sum;
}

glm::dvec3 normalOf(const LimitRun& run, const std::vector<glm::dvec3>& points) {
    glm::dvec3 normal(0.0);
    for (size_t k = 1; k < run.tangents.size(); ++k) {
        normal += glm::cross(weighted(run.tangents[k - 1], points), weighted(run.tangents[k], points));
    }
    return subdivision::unitOrZero(normal);
}

class ExactArrangements : public testing::TestWithParam<Subdivision> {};
INSTANTIATE_TEST_SUITE_P(Subdivisions, ExactArrangements, testing::Values(Subdivision::catmullClark, Subdivision::loop),
                         [](const auto& param) { return param.param == Subdivision::loop ? "Loop" : "CatmullClark"; });

/// The limit of a vertex does not depend on the level that it is computed on. A mean of normals does.
TEST_P(ExactArrangements, AStepChangesNoLimit) {
    double apart = 0.0, degrees = 0.0;
    size_t vertices = 0, darts = 0, normals = 0;
    for (const test::SubdivisionCage& zoo : test::subdivisionZoo()) {
        const Mesh mesh = test::subdivisionMesh(zoo.cage, GetParam());
        const std::vector<glm::dvec3> isolated = subdivision::isolate<double>(mesh, test::doublePositions(zoo.cage));
        const double size = test::extent(test::doublePositions(zoo.cage));
        for (const Fragment& fragment : mesh.fragments) {
            if (fragment.kind != subdivision::FragmentKind::vertex) {
                continue;
            }
            FragmentNet<double> net(mesh, isolated);
            net.load(fragment);
            const Fan fan = net.fanOf(fragment);
            const auto first = mesh.spokeSharpness.begin() + fragment.firstSpoke;
            Arrangement at{fan, {first, first + fragment.spokes()}, fragment.centreSharpness};
            const Limit before = limitOf(at);
            const std::vector<glm::dvec3> points = net.points();
            net.refine(fan, fanPattern(fan, 1), pointCount(fan, 3));
            at.spokes = softened(at.spokes, 1);
            at.vertex = softened(at.vertex, 1);
            const Limit after = limitOf(at);
            raise(apart, glm::distance(points[0] + weighted(before.position, points),
                                       net.points()[0] + weighted(after.position, net.points())) /
                             size);
            ASSERT_EQ(before.runs.size(), after.runs.size());
            for (size_t r = 0; r < before.runs.size(); ++r) {
                if (before.runs[r].tangents.size() > 2) {
                    continue;
                }
                const glm::dvec3 a = normalOf(before.runs[r], points), b = normalOf(after.runs[r], net.points());
                const double sine = glm::length(glm::cross(a, b));
                raise(degrees, std::atan2(sine, glm::dot(a, b)) * 180.0 / 3.14159265358979);
                ++normals;
            }
            ++vertices;
            darts +=
                std::count_if(at.spokes.begin(), at.spokes.end(), [](float s) { return s >= kInfiniteSharpness; }) == 1
                    ? 1
                    : 0;
        }
    }
    std::printf(
        "%zu vertices, %zu of them tips of darts; limit points within %.1e of the extent, %zu normals within %.1e "
        "degrees\n",
        vertices, darts, apart, normals, degrees);
    EXPECT_LE(apart, 1e-13);
    EXPECT_LE(degrees, 1e-3);
    EXPECT_GT(darts, 20u);
}

} // namespace
} // namespace supple::surface::chains
