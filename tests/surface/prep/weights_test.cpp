#include "surface/prep/weights.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace supple::surface::prep {
namespace {

double sum(const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0);
}

std::vector<Options> allOptions() {
    std::vector<Options> all;
    for (const TangentMode mode : {TangentMode::standard, TangentMode::printed}) {
        for (const CornerRule rule : {CornerRule::sharp, CornerRule::smooth}) {
            all.push_back({mode, rule});
        }
    }
    return all;
}

TEST(PrepWeights, limitPointsAreAffineAndTangentsAreVectors) {
    for (const Options& options : allOptions()) {
        for (uint32_t sectors = 1; sectors <= 40; ++sectors) {
            for (const bool boundary : {false, true}) {
                if (!boundary && sectors < 3) {
                    continue;
                }
                const ValenceClass k = makeValenceClass(sectors, boundary, options);
                EXPECT_EQ(k.sectors, sectors);
                EXPECT_EQ(k.boundary, boundary);
                const size_t spokes = sectors + (boundary ? 1 : 0);
                for (const auto* v : {&k.limitEdge, &k.e1Edge, &k.e2Edge, &k.cosines, &k.sines}) {
                    EXPECT_EQ(v->size(), spokes);
                }
                for (const auto* v : {&k.limitFace, &k.e1Face, &k.e2Face}) {
                    EXPECT_EQ(v->size(), sectors);
                }
                EXPECT_NEAR(k.limitCenter + sum(k.limitEdge) + sum(k.limitFace), 1.0, 1e-14);
                EXPECT_NEAR(k.e1Center + sum(k.e1Edge) + sum(k.e1Face), 0.0, 1e-13);
                EXPECT_NEAR(k.e2Center + sum(k.e2Edge) + sum(k.e2Face), 0.0, 1e-13);
            }
        }
    }
}

TEST(PrepWeights, regularClassesAreExact) {
    for (const Options& options : allOptions()) {
        const ValenceClass interior = makeValenceClass(4, false, options);
        EXPECT_EQ(interior.c, 0.0);
        EXPECT_EQ(interior.cosines, (std::vector<double>{1.0, 0.0, -1.0, 0.0}));
        EXPECT_EQ(interior.sines, (std::vector<double>{0.0, 1.0, 0.0, -1.0}));
        EXPECT_DOUBLE_EQ(interior.limitCenter, 16.0 / 36.0);
        EXPECT_DOUBLE_EQ(interior.limitEdge[2], 4.0 / 36.0);
        EXPECT_DOUBLE_EQ(interior.limitFace[2], 1.0 / 36.0);
        EXPECT_DOUBLE_EQ(interior.e1Edge[0], 4.0 / 36.0);
        EXPECT_EQ(interior.e1Edge[1], 0.0);
        EXPECT_DOUBLE_EQ(interior.e2Face[1], 1.0 / 36.0);
        EXPECT_DOUBLE_EQ(interior.e2Face[2], -1.0 / 36.0);

        const ValenceClass boundary = makeValenceClass(2, true, options);
        EXPECT_EQ(boundary.c, 0.0);
        EXPECT_EQ(boundary.cosines, (std::vector<double>{1.0, 0.0, -1.0}));
        EXPECT_EQ(boundary.sines, (std::vector<double>{0.0, 1.0, 0.0}));
        // The B-spline over ghosts reflected at the boundary.
        EXPECT_DOUBLE_EQ(boundary.e2Center, -4.0 / 18.0);
        EXPECT_DOUBLE_EQ(boundary.e2Edge[0], -1.0 / 18.0);
        EXPECT_DOUBLE_EQ(boundary.e2Edge[1], 4.0 / 18.0);
        EXPECT_DOUBLE_EQ(boundary.e2Edge[2], -1.0 / 18.0);
        EXPECT_DOUBLE_EQ(boundary.e2Face[0], 1.0 / 18.0);
        EXPECT_DOUBLE_EQ(boundary.e2Face[1], 1.0 / 18.0);
    }
    for (uint32_t n = 3; n <= 64; ++n) {
        EXPECT_EQ(makeValenceClass(n, false, {}).c == 0.0, n == 4);
    }
    for (uint32_t m = 1; m <= 64; ++m) {
        EXPECT_EQ(makeValenceClass(m, true, {}).c == 0.0, m == 2);
    }
}

TEST(PrepWeights, tangentLengths) {
    // K_n = e1 weight of spoke 0 divided by w.
    const auto length = [](uint32_t n, TangentMode mode) {
        const ValenceClass k = makeValenceClass(n, false, {mode, CornerRule::sharp});
        const double rho = (k.c + 5.0 + std::sqrt((k.c + 9.0) * (k.c + 1.0))) / 16.0;
        return k.e1Edge[0] / (16.0 * rho - 4.0);
    };
    const double standard[] = {0.038729502, 1.0 / 36.0, 0.022282722, 0.012084713, 0.009714710, 0.008159200};
    const double printed[] = {0.038729502, 1.0 / 36.0, 0.022282722, 0.019760623, 0.018377979, 0.017532117};
    for (uint32_t n = 3; n <= 8; ++n) {
        EXPECT_NEAR(length(n, TangentMode::standard), standard[n - 3], 1e-9);
        EXPECT_NEAR(length(n, TangentMode::printed), printed[n - 3], 1e-9);
    }
}

TEST(PrepWeights, corners) {
    const ValenceClass sharp = makeValenceClass(1, true, {TangentMode::standard, CornerRule::sharp});
    EXPECT_TRUE(sharp.sharpCorner);
    EXPECT_EQ(sharp.limitCenter, 1.0);
    EXPECT_EQ(sum(sharp.limitEdge) + sum(sharp.limitFace), 0.0);
    const ValenceClass smooth = makeValenceClass(1, true, {TangentMode::standard, CornerRule::smooth});
    EXPECT_FALSE(smooth.sharpCorner);
    EXPECT_DOUBLE_EQ(smooth.limitCenter, 2.0 / 3.0);
    EXPECT_DOUBLE_EQ(smooth.e1Edge[1], -1.0 / 6.0);
    EXPECT_DOUBLE_EQ(smooth.e2Center, -1.0 / 3.0);
    EXPECT_FALSE(makeValenceClass(2, true, {}).sharpCorner);
}

TEST(PrepWeights, edges) {
    EXPECT_EQ(makeEdgeWeights(0.0, 0.0), EdgeWeights{});
    std::vector<double> cosines;
    for (uint32_t n = 3; n <= 12; ++n) {
        cosines.push_back(makeValenceClass(n, false, {}).c);
    }
    for (const double a : cosines) {
        for (const double b : cosines) {
            const EdgeWeights forward = makeEdgeWeights(a, b);
            const EdgeWeights backward = makeEdgeWeights(b, a);
            for (size_t row = 0; row < 4; ++row) {
                const auto& r = forward[row];
                EXPECT_NEAR(r[0] + r[1] + r[2] + r[3] + 2.0 * (r[4] + r[5]), 0.0, 1e-12);
                // The edge read from its other end: the same weights, bit for bit.
                const auto& o = backward[row ^ 1];
                EXPECT_EQ(r, (std::array<double, 6>{o[3], o[2], o[1], o[0], o[5], o[4]}));
            }
        }
    }
}

} // namespace
} // namespace supple::surface::prep
