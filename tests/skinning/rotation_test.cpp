// The rotation of a matrix against the polar decomposition by Newton's iteration, and where that one has none.
#include "skinning/rotation.h"

#include "skinning/pose.h"
#include "tests/support/rigged_tube.h"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

namespace supple::skinning {
namespace {

using test::Noise;

glm::dquat randomRotation(Noise& noise) {
    return unit({noise(), noise(), noise(), noise()});
}

/// The orthogonal polar factor of a regular matrix (Higham 1986).
glm::dmat3 orthogonalFactor(glm::dmat3 m) {
    for (int i = 0; i < 100; ++i) {
        const glm::dmat3 next = 0.5 * (m + glm::transpose(glm::inverse(m)));
        const double change = glm::length(next[0] - m[0]) + glm::length(next[1] - m[1]) + glm::length(next[2] - m[2]);
        m = next;
        if (change < 1e-15) {
            break;
        }
    }
    return m;
}

double distance(const glm::dmat3& a, const glm::dmat3& b) {
    double worst = 0.0;
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) {
            worst = std::max(worst, std::abs(a[c][r] - b[c][r]));
        }
    }
    return worst;
}

TEST(Rotation, IsThePolarFactor) {
    Noise noise(1);
    double worst = 0.0;
    uint32_t mirrored = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dmat3 m(glm::dvec3(noise.vector()), glm::dvec3(noise.vector()), glm::dvec3(noise.vector()));
        if (std::abs(glm::determinant(m)) < 1e-3) {
            continue; // close to singular the factor is ill-conditioned
        }
        const bool mirrors = glm::determinant(m) < 0.0;
        mirrored += mirrors ? 1 : 0;
        const glm::dquat q = nearestRotation(m);
        EXPECT_NEAR(glm::dot(q, q), 1.0, 1e-14);
        worst = std::max(worst, distance(glm::mat3_cast(q), orthogonalFactor(m) * (mirrors ? -1.0 : 1.0)));
    }
    std::printf("largest difference from Newton's iteration: %.1e; %u matrices mirror\n", worst, mirrored);
    EXPECT_GT(mirrored, 500u);
    EXPECT_LT(worst, 1e-11);
}

TEST(Rotation, EvenScaleAndRoundingDoNotTurn) {
    // The short way through: the matrix but for its factor, also with the rounding of single precision.
    Noise noise(2);
    double worst = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dquat q = randomRotation(noise);
        const double scale = (i % 2 == 0 ? 1.0 : -1.0) * std::exp(5.0 * noise());
        const glm::dmat3 m(glm::mat3(glm::mat3_cast(q) * scale));
        worst = std::max(worst, distance(glm::mat3_cast(nearestRotation(m)), glm::mat3_cast(q)));
    }
    EXPECT_LT(worst, 5e-7);
}

TEST(Rotation, BothWaysAgreeWhereTheyMeet) {
    // Unevenness just below and above what the short way takes.
    Noise noise(3);
    for (int i = 0; i < 200; ++i) {
        const glm::dmat3 m = glm::mat3_cast(randomRotation(noise));
        glm::dmat3 below = m, above = m;
        below[0] *= 1.0 + 0.45e-6;
        above[0] *= 1.0 + 0.55e-6;
        EXPECT_LT(distance(glm::mat3_cast(nearestRotation(below)), glm::mat3_cast(nearestRotation(above))), 1e-6);
    }
}

TEST(Rotation, HalfTurnsHaveOne) {
    for (const glm::dvec3 axis :
         {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(0.6, 0.8, 0)}) {
        const glm::dmat3 m = 2.0 * glm::outerProduct(axis, axis) - glm::dmat3(1.0);
        EXPECT_LT(distance(glm::mat3_cast(nearestRotation(m)), m), 1e-14);
        glm::dmat3 uneven = m;
        uneven[1] *= 3.0;
        EXPECT_NEAR(glm::length(nearestRotation(uneven)), 1.0, 1e-14);
    }
}

TEST(Rotation, SingularMatricesGiveARotation) {
    EXPECT_EQ(nearestRotation(glm::dmat3(0.0)), glm::dquat(1.0, 0.0, 0.0, 0.0));
    Noise noise(4);
    for (int i = 0; i < 100; ++i) {
        const glm::dquat q = randomRotation(noise);
        glm::dmat3 flat = glm::mat3_cast(q);
        flat[2] = glm::dvec3(0.0); // a joint flattened to a plane: the rotation of what is left
        EXPECT_LT(distance(glm::mat3_cast(nearestRotation(flat)), glm::mat3_cast(q)), 1e-12);
        glm::dmat3 line(0.0);
        line[0] = glm::dvec3(noise.vector());
        EXPECT_NEAR(glm::length(nearestRotation(line)), 1.0, 1e-14);
        EXPECT_NEAR(glm::dot(glm::mat3_cast(nearestRotation(line))[0], glm::normalize(line[0])), 1.0, 1e-12);
        const glm::dmat3 tiny = glm::mat3_cast(q) * 1e-200;
        EXPECT_LT(distance(glm::mat3_cast(nearestRotation(tiny)), glm::mat3_cast(q)), 1e-12);
    }
}

} // namespace
} // namespace supple::skinning
