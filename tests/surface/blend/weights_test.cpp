// Fit matrices and chart tables.
#include "surface/blend/weights.h"
#include "tests/support/blend_vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>

namespace supple::surface::blend {
namespace {

constexpr std::array kFits{ChartKind::interior, ChartKind::boundary, ChartKind::cut};

/// Where the ring points stand in the chart.
std::vector<std::complex<double>> ringOf(const ChartClass& chartClass) {
    const double k = chartClass.turns();
    std::vector<std::complex<double>> ring;
    for (uint32_t i = 0; i < chartClass.ringPoints(); ++i) {
        const double radius = (i & 1u) != 0 ? std::exp2(2.0 / k) : 1.0;
        ring.push_back(std::polar(radius, std::numbers::pi * i / k));
    }
    return ring;
}

double power(std::complex<double> zeta, uint32_t row) {
    return std::pow(zeta.real(), row / 3) * std::pow(zeta.imag(), row % 3);
}

bool used(const FitMatrix& m, uint32_t row) {
    for (uint32_t i = 0; i < m.ringPoints; ++i) {
        if (m.weight(row, i) != 0.0) {
            return true;
        }
    }
    return false;
}

TEST(BlendFitMatrix, equalsTheStoredOnes) {
    const auto stored = test::storedFitMatrices();
    EXPECT_EQ(stored.size(), 14u);
    for (const auto& [name, rows] : stored) {
        const bool closed = name.substr(0, 6) == "closed";
        const auto sectors = static_cast<uint32_t>(std::stoul(name.substr(name.find('_') + 1)));
        const FitMatrix m = makeFitMatrix({closed ? ChartKind::interior : ChartKind::boundary, sectors});
        ASSERT_EQ(rows[0].size(), m.ringPoints + 1) << name;
        for (uint32_t row = 0; row < kCoefficients; ++row) {
            double sum = 0.0;
            for (uint32_t i = 0; i < m.ringPoints; ++i) {
                EXPECT_NEAR(m.weight(row, i), rows[row][i + 1], 1e-12) << name << " row " << row;
                sum += m.weight(row, i);
            }
            EXPECT_NEAR((row == 0 ? 1.0 : 0.0) - sum, rows[row][0], 1e-12) << name << " row " << row;
        }
    }
}

/// What is left of the ring is orthogonal to the monomials that were fitted: to those of the whole ring where it is
/// closed, else, V being a factor of all, at the points off the boundary.
TEST(BlendFitMatrix, isLeastSquares) {
    for (const ChartKind kind : kFits) {
        for (uint32_t sectors = kind == ChartKind::interior ? 3 : 2; sectors <= 40; ++sectors) {
            const ChartClass chartClass{kind, sectors};
            const FitMatrix m = makeFitMatrix(chartClass);
            const std::vector<std::complex<double>> ring = ringOf(chartClass);
            for (uint32_t data = 0; data < m.ringPoints; ++data) { // a 1 at one ring point, 0 elsewhere
                std::vector<double> left(ring.size());
                for (uint32_t i = 0; i < ring.size(); ++i) {
                    left[i] = i == data ? -1.0 : 0.0;
                    for (uint32_t row = 1; row < kCoefficients; ++row) {
                        left[i] += m.weight(row, data) * power(ring[i], row);
                    }
                }
                for (uint32_t row = 1; row < kCoefficients; ++row) {
                    if (!used(m, row) || (kind != ChartKind::interior && row % 3 == 0)) {
                        continue;
                    }
                    double sum = 0.0;
                    for (uint32_t i = 0; i < ring.size(); ++i) {
                        sum += left[i] * power(ring[i], row);
                    }
                    EXPECT_NEAR(sum, 0.0, 1e-12) << sectors << " sectors, row " << row;
                }
                if (kind != ChartKind::interior) { // the ends are interpolated
                    EXPECT_NEAR(left.front(), 0.0, 1e-13);
                    EXPECT_NEAR(left.back(), 0.0, 1e-13);
                }
                if (chartClass.turns() == 4) {
                    for (const double rest : left) {
                        EXPECT_NEAR(rest, 0.0, 1e-15) << "four turns pass through the whole ring";
                    }
                }
            }
        }
    }
}

TEST(BlendFitMatrix, zerosAreExact) {
    for (const ChartKind kind : kFits) {
        for (uint32_t sectors = kind == ChartKind::interior ? 3 : 1; sectors <= 40; ++sectors) {
            const ChartClass chartClass{kind, sectors};
            const FitMatrix m = makeFitMatrix(chartClass);
            EXPECT_FALSE(used(m, 0));
            const bool square = kind == ChartKind::interior && sectors == 4;
            EXPECT_EQ(used(m, 5), square);
            EXPECT_EQ(used(m, 8), square);
            EXPECT_EQ(used(m, 7), chartClass.turns() == 4 && m.ringPoints >= 5);
            if (chartClass.turns() == 4) {
                for (const double weight : m.weights) {
                    EXPECT_EQ(4.0 * weight, std::round(4.0 * weight)) << "quarters";
                }
            }
            if (kind != ChartKind::interior && !(kind == ChartKind::boundary && sectors == 1)) {
                // The curve along the boundary or crease is the same from the other side.
                for (uint32_t i = 0; i < m.ringPoints; ++i) {
                    const bool end = i == 0 || i + 1 == m.ringPoints;
                    EXPECT_EQ(m.weight(3, i), !end ? 0.0 : i == 0 ? 0.5 : -0.5);
                    EXPECT_EQ(m.weight(6, i), end ? 0.5 : 0.0);
                }
            }
        }
    }
    EXPECT_TRUE(makeFitMatrix({ChartKind::point, 0}).weights.empty());
}

TEST(BlendFitMatrix, aSideOfTwoSectorsIsABoundary) {
    for (uint32_t sectors = 2; sectors <= 12; ++sectors) {
        EXPECT_EQ(makeFitMatrix({ChartKind::cut, sectors}).weights,
                  makeFitMatrix({ChartKind::boundary, sectors}).weights);
    }
}

/// The surface must not know which spoke is the first: turned data give the turned polynomial.
TEST(BlendFitMatrix, turnsWithTheRing) {
    for (uint32_t sectors = 3; sectors <= 12; ++sectors) {
        const ChartClass chartClass{ChartKind::interior, sectors};
        const FitMatrix m = makeFitMatrix(chartClass);
        const std::complex<double> zeta = std::polar(0.6, 0.3);
        const std::complex<double> turned = zeta * std::polar(1.0, -2.0 * std::numbers::pi / sectors);
        for (uint32_t i = 0; i < m.ringPoints; ++i) {
            double a = 0.0, b = 0.0;
            for (uint32_t row = 1; row < kCoefficients; ++row) {
                a += m.weight(row, (i + 2) % m.ringPoints) * power(zeta, row);
                b += m.weight(row, i) * power(turned, row);
            }
            EXPECT_NEAR(a, b, 1e-14) << sectors;
        }
    }
}

/// An open chart is half a plane: what it makes of flat fans over more than half a turn.
TEST(BlendFitMatrix, reflexFansFlatten) {
    constexpr uint32_t kSectors = 5;
    const FitMatrix m = makeFitMatrix({ChartKind::boundary, kSectors});
    const auto area = [&](double turns) { // of c_10 and c_01
        std::array<glm::dvec2, 2> c{};
        for (uint32_t i = 0; i < m.ringPoints; ++i) {
            const auto spoke = [&](uint32_t h) {
                const double angle = 2.0 * std::numbers::pi * turns * h / kSectors;
                return glm::dvec2(std::cos(angle), std::sin(angle));
            };
            const glm::dvec2 p = (i & 1u) != 0 ? spoke(i / 2) + spoke(i / 2 + 1) : spoke(i / 2);
            c[0] += m.weight(3, i) * p;
            c[1] += m.weight(1, i) * p;
        }
        return c[0].x * c[1].y - c[0].y * c[1].x;
    };
    EXPECT_NEAR(area(0.5), 0.9, 0.05);
    EXPECT_NEAR(area(0.7), 0.5, 0.05);
    EXPECT_NEAR(area(0.8), 0.2, 0.05);
}

TEST(BlendTables, coordinates) {
    for (const uint32_t rate : {1u, 2u, 5u}) {
        for (uint32_t i = 0; i < coordinateCount(rate); ++i) {
            const auto value = [&](uint32_t k) {
                const Coordinate c = coordinateAt(rate, k);
                return static_cast<double>(c.numerator) / c.denominator;
            };
            EXPECT_NEAR(value(i) + value(mirrored(rate, i)), 1.0, 1e-15);
        }
        EXPECT_EQ(coordinateAt(rate, firstHalfStep(rate)).denominator, 2 * rate);
    }
}

TEST(BlendTables, samplesOfCharts) {
    constexpr uint32_t kRate = 6;
    const uint32_t side = coordinateCount(kRate);
    for (const uint32_t k : {2u, 3u, 4u, 5u, 7u, 8u, 12u, 26u}) {
        const ChartTable chart = makeChartTable(k, kRate);
        const CreaseTable crease = makeCreaseTable(k, kRate);
        ASSERT_EQ(chart.directions.size(), k + 1);
        EXPECT_EQ(chart.directions.front(), chart.directions.back());
        if (k % 2 == 0) {
            EXPECT_EQ(chart.directions[k / 2], glm::dvec2(-1.0, 0.0)); // T = -1 and V = 0 at the crease's other end
        }
        for (uint32_t j = 0; j < side; ++j) {
            for (uint32_t i = 0; i < side; ++i) {
                const Coordinate x = coordinateAt(kRate, i), y = coordinateAt(kRate, j);
                const std::complex<double> z(static_cast<double>(x.numerator) / x.denominator,
                                             static_cast<double>(y.numerator) / y.denominator);
                const uint32_t index = j * side + i;
                const std::complex<double> zeta(chart.points[index].x, chart.points[index].y);
                const std::complex<double> slope(chart.slopes[index].x, chart.slopes[index].y);
                if (std::abs(z) == 0.0) {
                    EXPECT_EQ(std::abs(zeta) + std::abs(slope), 0.0);
                    continue;
                }
                EXPECT_LT(std::abs(zeta - std::pow(z, 4.0 / k)), 1e-14);
                EXPECT_LT(std::abs(slope - 4.0 / k * zeta / z), 1e-12 * std::abs(slope));
                if (j == 0) {
                    EXPECT_NEAR(zeta.real(), chart.radii[i], 1e-15);
                }
                // T = |z| cos(4 arg z / k), and its derivatives by small differences.
                const auto t = [&](std::complex<double> at) { return std::abs(at) * std::cos(4.0 / k * std::arg(at)); };
                constexpr double kStep = 1e-6;
                EXPECT_NEAR(crease.points[index].x, t(z), 1e-15);
                EXPECT_NEAR(crease.slopesX[index].x, (t(z + kStep) - t(z - kStep)) / (2.0 * kStep), 1e-8);
                const std::complex<double> up(0.0, kStep);
                EXPECT_NEAR(crease.slopesY[index].x, (t(z + up) - t(z - up)) / (2.0 * kStep), 1e-8);
            }
        }
    }
}

} // namespace
} // namespace supple::surface::blend
