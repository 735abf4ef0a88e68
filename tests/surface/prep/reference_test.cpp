// What the p-rep surface is known to equal: B-splines, limits of Catmull-Clark subdivision; and what it must not depend
// on.
#include "tests/support/meshes.h"
#include "tests/support/prep_surface.h"
#include "tests/support/prep_vectors.h"
#include "tests/support/worst.h"

#include "surface/build.h"
#include "tools/common/procedural.h"

#include <functional>

namespace supple::surface::prep {
namespace {

using test::PrepSurface;
using test::raise;

struct NamedCage {
    std::string name;
    cage::Cage cage;
};

/// Closed and open cages with valences 3..12 in the interior and 1..5 faces on the boundary, none of them symmetric.
std::vector<NamedCage> assortedCages() {
    const cage::Cage sphere = cage::makeCubeSphere(3);
    std::vector<NamedCage> cages{
        {"cube", test::perturbed(test::cube(), 0.2f, 1)},
        {"torus", test::perturbed(test::torus(5, 4), 0.1f, 2)},
        {"trapezohedron 5", test::perturbed(test::trapezohedron(5), 0.05f, 3)},
        {"trapezohedron 12", test::perturbed(test::trapezohedron(12), 0.02f, 4)},
        {"split torus", test::perturbed(cage::makeSplitTorus(4, 3), 0.02f, 5)},
        {"grid", test::perturbed(test::grid(4, 3), 0.2f, 6)},
        {"sphere with holes", test::perturbed(test::withoutFaces(sphere, {0, 13, 31, 32, 40}), 0.03f, 7)},
    };
    for (const uint32_t m : {1u, 2u, 3u, 4u, 5u}) {
        cages.push_back(
            {"open fan " + std::to_string(m), test::perturbed(test::fan(m, 2, 0.9 * m, false), 0.05f, 8 + m)});
    }
    for (const uint32_t n : {3u, 5u, 6u, 8u}) {
        cages.push_back({"closed fan " + std::to_string(n),
                         test::perturbed(test::fan(n, 2, 2.0 * std::numbers::pi, true), 0.05f, 20 + n)});
    }
    return cages;
}

PrepSurface<double> surfaceOf(const cage::Cage& cage, const Options& options = {}) {
    return PrepSurface<double>(cage, test::doublePositions(cage), options);
}

/// A uniform bicubic B-spline with value and partial derivatives of the segment between control points 1 and 2.
struct SplineSample {
    glm::dvec3 position, du, dv;
};

SplineSample bicubicSpline(const std::function<glm::dvec3(int, int)>& control, double u, double v) {
    const auto basis = [](double t) {
        const double s = 1.0 - t;
        return std::array{s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
                          (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0, t * t * t / 6.0};
    };
    const auto slope = [](double t) {
        const double s = 1.0 - t;
        return std::array{-s * s / 2.0, (3.0 * t * t - 4.0 * t) / 2.0, -(3.0 * s * s - 4.0 * s) / 2.0, t * t / 2.0};
    };
    SplineSample result{glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            const glm::dvec3 p = control(i - 1, j - 1);
            result.position += basis(u)[i] * basis(v)[j] * p;
            result.du += slope(u)[i] * basis(v)[j] * p;
            result.dv += basis(u)[i] * slope(v)[j] * p;
        }
    }
    return result;
}

TEST(PrepReference, allValencesFourIsTheBicubicSpline) {
    constexpr int kAround = 7;
    constexpr int kAcross = 5;
    const cage::Cage cage = test::perturbed(test::torus(kAround, kAcross), 0.3f, 1);
    const PrepSurface<double> surface = surfaceOf(cage);
    for (const auto& h : surface.coefficients.edgeCoefficients) {
        for (const glm::dvec3& v : h) {
            EXPECT_EQ(v, glm::dvec3(0.0)); // exactly
        }
    }
    double worst = 0.0;
    for (int x = 0; x < kAround; ++x) {
        for (int y = 0; y < kAcross; ++y) {
            const uint32_t face = x * kAcross + y;
            EXPECT_FALSE(surface.patches[face].perturbed);
            const auto control = [&](int i, int j) {
                return glm::dvec3(cage.positions[(x + i + kAround) % kAround * kAcross + (y + j + kAcross) % kAcross]);
            };
            for (uint32_t j = 0; j <= 8; ++j) {
                for (uint32_t i = 0; i <= 8; ++i) {
                    const Sample<double> s = surface.at(face, i, j, 8);
                    const SplineSample b = bicubicSpline(control, i / 8.0, j / 8.0);
                    raise(worst, glm::distance(s.position, b.position));
                    raise(worst, glm::distance(s.du, b.du));
                    raise(worst, glm::distance(s.dv, b.dv));
                }
            }
        }
    }
    EXPECT_LE(worst, 3e-14);
}

TEST(PrepReference, openGridIsTheSplineOverReflectedGhosts) {
    constexpr int kColumns = 4;
    constexpr int kRows = 3;
    const cage::Cage cage = test::perturbed(test::grid(kColumns, kRows), 0.3f, 2);
    const PrepSurface<double> surface = surfaceOf(cage);
    // Control point (x, y), one step outside the grid reflected: sharp corners are reflected twice.
    const std::function<glm::dvec3(int, int)> at = [&](int x, int y) -> glm::dvec3 {
        if (x < 0 || x > kColumns) {
            const int edge = x < 0 ? 0 : kColumns;
            return 2.0 * at(edge, y) - at(2 * edge - x, y);
        }
        if (y < 0 || y > kRows) {
            const int edge = y < 0 ? 0 : kRows;
            return 2.0 * at(x, edge) - at(x, 2 * edge - y);
        }
        return glm::dvec3(cage.positions[y * (kColumns + 1) + x]);
    };
    double worst = 0.0;
    for (int y = 0; y < kRows; ++y) {
        for (int x = 0; x < kColumns; ++x) {
            const auto control = [&](int i, int j) { return at(x + i, y + j); };
            for (uint32_t j = 0; j <= 8; ++j) {
                for (uint32_t i = 0; i <= 8; ++i) {
                    const Sample<double> s = surface.at(y * kColumns + x, i, j, 8);
                    const SplineSample b = bicubicSpline(control, i / 8.0, j / 8.0);
                    raise(worst, glm::distance(s.position, b.position));
                    raise(worst, glm::distance(s.du, b.du));
                    raise(worst, glm::distance(s.dv, b.dv));
                }
            }
        }
    }
    EXPECT_LE(worst, 3e-14);
}

TEST(PrepReference, derivativesMatchDifferences) {
    const PrepSurface<double> surface = surfaceOf(test::perturbed(test::trapezohedron(6), 0.1f, 3));
    constexpr double kStep = 1e-4;
    double worst = 0.0;
    for (const Patch<double>& patch : surface.patches) {
        for (const glm::dvec2 at : {glm::dvec2(0.3, 0.4), glm::dvec2(0.1, 0.9), glm::dvec2(0.75, 0.2)}) {
            const auto sample = [&](double u, double v) { return evaluate<double>(patch, {u, 1.0 - u}, {v, 1.0 - v}); };
            const Sample<double> s = sample(at.x, at.y);
            const glm::dvec3 du =
                (sample(at.x + kStep, at.y).position - sample(at.x - kStep, at.y).position) / (2.0 * kStep);
            const glm::dvec3 dv =
                (sample(at.x, at.y + kStep).position - sample(at.x, at.y - kStep).position) / (2.0 * kStep);
            raise(worst, glm::distance(s.du, du));
            raise(worst, glm::distance(s.dv, dv));
        }
    }
    EXPECT_LE(worst, 1e-6);
}

/// Catmull-Clark keeps its limit: the limit points and normals computed from a refined cage are those of the cage
/// itself. With the convergence below, this pins the limit masks without using them.
TEST(PrepReference, limitsSurviveSubdivision) {
    for (const NamedCage& named : assortedCages()) {
        for (const CornerRule rule : {CornerRule::sharp, CornerRule::smooth}) {
            const Options options{TangentMode::standard, rule};
            std::vector<glm::dvec3> positions = test::doublePositions(named.cage);
            const PrepSurface<double> coarse(named.cage, positions, options);
            test::RefinedCage refined = test::refineCatmullClark(named.cage, positions, rule == CornerRule::sharp);
            refined = test::refineCatmullClark(refined.cage, refined.positions, rule == CornerRule::sharp);
            const PrepSurface<double> fine(refined.cage, refined.positions, options);
            const double extent = test::extent(positions);
            for (uint32_t v = 0; v < named.cage.vertexCount(); ++v) {
                EXPECT_LE(glm::distance(coarse.coefficients.limitPoints[v], fine.coefficients.limitPoints[v]) / extent,
                          1e-14)
                    << named.name << ", vertex " << v;
                // A sharp corner's limit plane is spanned by its two edges only where the rules keep them straight.
                EXPECT_LE(test::angleDegrees(coarse.coefficients.limitNormals[v], fine.coefficients.limitNormals[v]),
                          1e-9)
                    << named.name << ", vertex " << v;
            }
        }
    }
}

TEST(PrepReference, subdivisionConvergesToTheLimitPoints) {
    for (const NamedCage& named : assortedCages()) {
        std::vector<glm::dvec3> positions = test::doublePositions(named.cage);
        const PrepSurface<double> surface(named.cage, positions);
        test::RefinedCage refined{named.cage, positions};
        const auto distance = [&] {
            double worst = 0.0;
            for (uint32_t v = 0; v < named.cage.vertexCount(); ++v) {
                raise(worst, glm::distance(refined.positions[v], surface.coefficients.limitPoints[v]));
            }
            return worst;
        };
        double last = distance();
        for (int level = 0; level < 4; ++level) {
            refined = test::refineCatmullClark(refined.cage, refined.positions, true);
            const double now = distance();
            EXPECT_LE(now, 0.62 * last + 1e-15) << named.name << ", level " << level;
            last = now;
        }
    }
}

TEST(PrepReference, patchCornersAreTheLimits) {
    for (const NamedCage& named : assortedCages()) {
        for (const CornerRule rule : {CornerRule::sharp, CornerRule::smooth}) {
            const PrepSurface<double> surface = surfaceOf(named.cage, {TangentMode::standard, rule});
            for (uint32_t c = 0; c < named.cage.cornerCount(); ++c) {
                const uint32_t v = named.cage.faceVertices[c];
                const Sample<double> s = surface.onEdge(c, 0, 8);
                EXPECT_EQ(s.position, surface.coefficients.limitPoints[v]);
                EXPECT_LE(test::angleDegrees(s.normal, surface.coefficients.limitNormals[v]), 1e-9)
                    << named.name << ", vertex " << v;
                EXPECT_NEAR(glm::length(s.normal), 1.0, 1e-14);
            }
        }
    }
}

TEST(PrepReference, boundaryCurveIsTheCubicSpline) {
    for (const NamedCage& named : assortedCages()) {
        for (const CornerRule rule : {CornerRule::sharp, CornerRule::smooth}) {
            const PrepSurface<double> surface = surfaceOf(named.cage, {TangentMode::standard, rule});
            const cage::Topology& t = surface.topology;
            const auto p = [&](uint32_t v) { return glm::dvec3(named.cage.positions[v]); };
            double worst = 0.0;
            for (const cage::Topology::Edge& edge : t.edges) {
                if (edge.twin != cage::kNone) {
                    continue;
                }
                // a -> b runs with the face on its left, so spoke 0 of b leads on and the last spoke of a leads back.
                const uint32_t a = named.cage.faceVertices[edge.corner];
                const uint32_t b =
                    named.cage.faceVertices[nextCorner(named.cage, t.cornerFaces[edge.corner], edge.corner)];
                const auto sharp = [&](uint32_t v) { return rule == CornerRule::sharp && t.sectorCount(v) == 1; };
                const glm::dvec3 before = sharp(a) ? 2.0 * p(a) - p(b) : p(t.spokeVertices[t.spokeStarts[a + 1] - 1]);
                const glm::dvec3 after = sharp(b) ? 2.0 * p(b) - p(a) : p(t.spokeVertices[t.spokeStarts[b]]);
                for (uint32_t k = 0; k <= 8; ++k) {
                    const double u = k / 8.0;
                    const auto row = [&](int i, int) { return i < 0 ? before : i == 0 ? p(a) : i == 1 ? p(b) : after; };
                    const glm::dvec3 spline = bicubicSpline(row, u, 0.5).position; // constant across: a curve
                    raise(worst, glm::distance(surface.onEdge(edge.corner, k, 8).position, spline));
                }
            }
            EXPECT_LE(worst, 2e-14) << named.name;
        }
    }
}

TEST(PrepReference, affineInvariance) {
    const glm::dmat3 linear(1.3, -0.7, 0.2, 0.4, 0.9, -0.5, -0.2, 0.1, 1.6);
    const glm::dvec3 shift(3.0, -2.0, 5.0);
    for (const NamedCage& named : assortedCages()) {
        for (const CornerRule rule : {CornerRule::sharp, CornerRule::smooth}) {
            const Options options{TangentMode::standard, rule};
            const std::vector<glm::dvec3> positions = test::doublePositions(named.cage);
            std::vector<glm::dvec3> moved;
            for (const glm::dvec3& p : positions) {
                moved.push_back(linear * p + shift);
            }
            const PrepSurface<double> first(named.cage, positions, options);
            const PrepSurface<double> second(named.cage, moved, options);
            double worst = 0.0;
            for (uint32_t f = 0; f < named.cage.faceCount(); ++f) {
                for (uint32_t i = 0; i < 25; ++i) {
                    raise(worst, glm::distance(linear * first.at(f, i % 5, i / 5, 4).position + shift,
                                               second.at(f, i % 5, i / 5, 4).position));
                }
            }
            EXPECT_LE(worst / test::extent(moved), 1e-13) << named.name;
        }
    }
}

TEST(PrepReference, independentOfTheStartingCorner) {
    for (const NamedCage& named : assortedCages()) {
        const PrepSurface<double> first = surfaceOf(named.cage);
        const PrepSurface<double> second = surfaceOf(test::rotatedFaces(named.cage));
        double worst = 0.0;
        double worstNormal = 0.0;
        for (uint32_t f = 0; f < named.cage.faceCount(); ++f) {
            for (uint32_t y = 0; y <= 4; ++y) {
                for (uint32_t x = 0; x <= 4; ++x) {
                    // (x, y) counted from corner f mod 4 of the first cage's face.
                    const uint32_t at[4][2] = {{x, y}, {4 - y, x}, {4 - x, 4 - y}, {y, 4 - x}};
                    const Sample<double> a = first.at(f, at[f % 4][0], at[f % 4][1], 4);
                    const Sample<double> b = second.at(f, x, y, 4);
                    raise(worst, glm::distance(a.position, b.position));
                    raise(worstNormal, glm::distance(a.normal, b.normal));
                }
            }
        }
        EXPECT_LE(worst, 1e-13) << named.name;
        EXPECT_LE(worstNormal, 1e-10) << named.name;
    }
}

TEST(PrepReference, perturbationOnlyWhereAValenceIsIrregular) {
    const cage::Cage cage = cage::makeCubeSphere(5);
    const PrepSurface<double> surface = surfaceOf(cage);
    uint32_t perturbed = 0;
    for (const Patch<double>& patch : surface.patches) {
        perturbed += patch.perturbed ? 1 : 0;
        if (!patch.perturbed) {
            for (const glm::dvec3& h : patch.h) {
                EXPECT_EQ(h, glm::dvec3(0.0));
            }
        }
    }
    EXPECT_EQ(perturbed, 24u); // three quads round each cube corner
}

TEST(PrepTables, creasesAreSaidToBeSmooth) {
    cage::Cage cage = test::cube();
    const auto notes = [&] {
        const Result<Tables> tables = build(Recipe{}, cage);
        EXPECT_TRUE(tables.ok());
        return tables ? tables->notes : std::vector<std::string>();
    };
    EXPECT_EQ(notes(), std::vector<std::string>());
    const uint32_t a = cage.faceVertices[0], b = cage.faceVertices[1], c = cage.faceVertices[2];
    cage.creases = {{a, b, 0.0f}, {b, c, 2.5f}};
    const std::string edge = "edge (" + std::to_string(b) + ", " + std::to_string(c) + ")";
    EXPECT_EQ(notes(), std::vector<std::string>{"p-rep has no creases: 1 crease is drawn smooth: " + edge});
    cage.creases.push_back({a, b, 10.0f});
    cage.sharpVertices = {{a, 10.0f}};
    const std::vector<std::string> both{"p-rep has no creases: 2 creases are drawn smooth, the first is " + edge,
                                        "p-rep has no sharp vertices: 1 is drawn smooth: vertex " + std::to_string(a)};
    EXPECT_EQ(notes(), both);
}

} // namespace
} // namespace supple::surface::prep
