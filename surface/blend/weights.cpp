#include "surface/blend/weights.h"

#include "surface/valence.h"

#include <array>
#include <cmath>

namespace supple::surface::blend {
namespace {

/// Rows of a FitMatrix by the powers of U and V.
constexpr uint32_t row(uint32_t a, uint32_t b) {
    return 3 * a + b;
}

class Fit {
public:
    explicit Fit(const ChartClass& chartClass) : class_(chartClass), sectors_(chartClass.sectors) {
        matrix_.ringPoints = chartClass.ringPoints();
        matrix_.weights.assign(size_t{kCoefficients} * matrix_.ringPoints, 0.0);
    }

    FitMatrix run() {
        switch (class_.kind) {
        case ChartKind::point:
            break;
        case ChartKind::curve:
            fitCurve();
            break;
        case ChartKind::interior:
            sectors_ == 4 ? fitSquare(2, 2) : fitRing();
            break;
        case ChartKind::boundary:
            sectors_ == 1 ? fitSquare(1, 1) : fitOpen();
            break;
        case ChartKind::cut:
            sectors_ == 1 ? fitSingle() : fitOpen();
            break;
        }
        return std::move(matrix_);
    }

private:
    double& at(uint32_t row, uint32_t ringPoint) { return matrix_.weights[row * matrix_.ringPoints + ringPoint]; }

    /// The quadratic through the curve's ends with the tangent polygon end, vertex, end.
    void fitCurve() {
        for (const uint32_t end : {0u, 1u}) {
            at(row(0, 0), end) = 0.25;
            at(row(1, 0), end) = end == 0 ? 0.5 : -0.5;
            at(row(2, 0), end) = 0.25;
        }
    }

    /// The weights in the coefficient of x^power of a value at x = place: of the polynomial of degree 1 through 0 and
    /// 1, or of degree 2 through -1, 0 and 1.
    static double axisWeight(uint32_t degree, uint32_t power, int32_t place) {
        if (power == 0) {
            return place == 0 ? 1.0 : 0.0;
        }
        if (degree == 1) {
            return place == 0 ? -1.0 : 1.0;
        }
        return power == 1 ? 0.5 * place : place == 0 ? -1.0 : 0.5;
    }

    /// k = 4: the ring stands on the points of a square grid, and a tensor product passes through all of it.
    void fitSquare(uint32_t degreeU, uint32_t degreeV) {
        struct Place {
            int32_t u, v;
        };
        constexpr std::array<Place, 8> kPlaces{{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
        for (uint32_t a = 0; a <= degreeU; ++a) {
            for (uint32_t b = a == 0 ? 1 : 0; b <= degreeV; ++b) {
                for (uint32_t i = 0; i < matrix_.ringPoints; ++i) {
                    at(row(a, b), i) = axisWeight(degreeU, a, kPlaces[i].u) * axisWeight(degreeV, b, kPlaces[i].v);
                }
            }
        }
    }

    /// Two rings of k points each at equal angles, ring points alternating between them: U, V, U^2 + V^2, U^2 - V^2 and
    /// 2 U V are their harmonics 1, 0 and 2, which are orthogonal on either ring. But for k = 3, where the second
    /// harmonic is the first one backwards, so that the two pass through what the rings have of it.
    void fitRing() {
        const double k = sectors_;
        const double r = std::exp2(2.0 / k); // of the faces' far corners
        const double r2 = r * r, r4 = r2 * r2;
        // What a unit of the harmonic on the ring of edges, and on that of faces, gives in the polynomial.
        const bool three = sectors_ == 3;
        const std::array<double, 2> first =
            three ? std::array{r / (1.0 + r), 1.0 / (r * (1.0 + r))} : std::array{1.0 / (1.0 + r2), r / (1.0 + r2)};
        const std::array<double, 2> second =
            three ? std::array{1.0 / (1.0 + r), 1.0 / (r * (1.0 + r))} : std::array{1.0 / (1.0 + r4), r2 / (1.0 + r4)};
        const std::array<double, 2> mean{1.0 / (1.0 + r4), r2 / (1.0 + r4)};
        for (uint32_t i = 0; i < matrix_.ringPoints; ++i) {
            const uint32_t ring = i & 1u;
            const double cosine = cosineOfHalfTurns(i, sectors_), sine = sineOfHalfTurns(i, sectors_);
            const double cosine2 = cosineOfHalfTurns(2 * i, sectors_), sine2 = sineOfHalfTurns(2 * i, sectors_);
            at(row(1, 0), i) = 2.0 / k * first[ring] * cosine;
            at(row(0, 1), i) = 2.0 / k * first[ring] * sine;
            at(row(2, 0), i) = (mean[ring] + 2.0 * second[ring] * cosine2) / k;
            at(row(0, 2), i) = (mean[ring] - 2.0 * second[ring] * cosine2) / k;
            at(row(1, 1), i) = 4.0 / k * second[ring] * sine2;
        }
    }

    /// A fan over half a plane. The polynomial in U passes through the vertex and the two ends, so that the boundary is
    /// made of boundary vertices alone; V, U V and V^2 are fitted to what remains at the other points. Under U -> -U
    /// the second changes its sign and the others do not: one equation, and two.
    void fitOpen() {
        if (sectors_ == 2) {
            fitSquare(2, 1);
            return;
        }
        const uint32_t last = matrix_.ringPoints - 1;
        const double r = std::exp2(1.0 / sectors_);
        double v2 = 0.0, v3 = 0.0, v4 = 0.0, uv2 = 0.0; // sums of V^2, V^3, V^4, (U V)^2
        const auto place = [&](uint32_t i) {
            return glm::dvec2(cosineOfHalfTurns(i, 2 * sectors_), sineOfHalfTurns(i, 2 * sectors_)) *
                   ((i & 1u) != 0 ? r : 1.0);
        };
        for (uint32_t i = 1; i < last; ++i) {
            const glm::dvec2 p = place(i);
            v2 += p.y * p.y;
            v3 += p.y * p.y * p.y;
            v4 += p.y * p.y * p.y * p.y;
            uv2 += p.x * p.x * p.y * p.y;
        }
        const double determinant = v2 * v4 - v3 * v3;
        at(row(1, 0), 0) = at(row(2, 0), 0) = at(row(2, 0), last) = 0.5;
        at(row(1, 0), last) = -0.5;
        for (uint32_t i = 1; i < last; ++i) {
            const glm::dvec2 p = place(i);
            at(row(0, 1), i) = (v4 * p.y - v3 * p.y * p.y) / determinant;
            at(row(0, 2), i) = (v2 * p.y * p.y - v3 * p.y) / determinant;
            at(row(1, 1), i) = p.x * p.y / uv2;
            for (const uint32_t fitted : {row(0, 1), row(0, 2), row(1, 1)}) {
                at(fitted, 0) -= at(fitted, i) * 0.5 * (p.x * p.x + p.x);
                at(fitted, last) -= at(fitted, i) * 0.5 * (p.x * p.x - p.x);
            }
        }
    }

    /// One face on a side of a crease: two ends as above, and the far corner at zeta = 2 i.
    void fitSingle() {
        at(row(1, 0), 0) = at(row(2, 0), 0) = at(row(2, 0), 2) = 0.5;
        at(row(1, 0), 2) = -0.5;
        at(row(0, 1), 1) = 0.5;
    }

    ChartClass class_;
    uint32_t sectors_;
    FitMatrix matrix_;
};

/// Calls `at` with the index and x, y of every sample of a table.
template <class At>
void forEachSample(uint32_t rate, At&& at) {
    const uint32_t side = coordinateCount(rate);
    const auto value = [&](uint32_t coordinate) { return coordinateAt(rate, coordinate).value(); };
    for (uint32_t j = 0; j < side; ++j) {
        for (uint32_t i = 0; i < side; ++i) {
            at(j * side + i, value(i), value(j));
        }
    }
}

} // namespace

FitMatrix makeFitMatrix(const ChartClass& chartClass) {
    return Fit(chartClass).run();
}

Coordinate coordinateAt(uint32_t rate, uint32_t coordinate) {
    if (coordinate <= rate) {
        return {coordinate, rate};
    }
    return {coordinate == firstHalfStep(rate) ? 1 : 2 * rate - 1, 2 * rate};
}

std::vector<glm::dvec2> chartDirections(uint32_t turns) {
    std::vector<glm::dvec2> directions;
    for (uint32_t h = 0; h <= turns; ++h) {
        const auto [cosine, sine] = turn(h, turns);
        directions.emplace_back(cosine, sine);
    }
    return directions;
}

ChartTable makeChartTable(uint32_t turns, uint32_t rate) {
    ChartTable table;
    table.turns = turns;
    table.rate = rate;
    table.directions = chartDirections(turns);
    const double power = 4.0 / turns;
    const uint32_t side = coordinateCount(rate);
    table.points.resize(size_t{side} * side);
    table.slopes.resize(table.points.size());
    for (uint32_t i = 0; i < side; ++i) {
        table.radii.push_back(std::pow(coordinateAt(rate, i).value(), power));
    }
    forEachSample(rate, [&](uint32_t index, double x, double y) {
        const double length = std::hypot(x, y), angle = std::atan2(y, x);
        if (turns == 4) {
            table.points[index] = {x, y};
            table.slopes[index] = length > 0.0 ? glm::dvec2(1.0, 0.0) : glm::dvec2(0.0);
        } else if (length > 0.0) {
            const double radius = std::pow(length, power), slope = power * std::pow(length, power - 1.0);
            table.points[index] = radius * glm::dvec2(std::cos(power * angle), std::sin(power * angle));
            table.slopes[index] = slope * glm::dvec2(std::cos((power - 1.0) * angle), std::sin((power - 1.0) * angle));
        }
    });
    return table;
}

CreaseTable makeCreaseTable(uint32_t turns, uint32_t rate) {
    CreaseTable table;
    const double factor = 4.0 / turns;
    const uint32_t side = coordinateCount(rate);
    for (std::vector<glm::dvec2>* values : {&table.points, &table.slopesX, &table.slopesY}) {
        values->resize(size_t{side} * side);
    }
    forEachSample(rate, [&](uint32_t index, double x, double y) {
        const double length = std::hypot(x, y), angle = std::atan2(y, x);
        const double cosine = length > 0.0 ? x / length : 1.0, sine = length > 0.0 ? y / length : 0.0;
        // e^(i factor angle), and i times it: what |z| and the angle change, along x and along y.
        const glm::dvec2 turned{std::cos(factor * angle), std::sin(factor * angle)};
        const glm::dvec2 across{-turned.y, turned.x};
        table.points[index] = length * turned;
        table.slopesX[index] = cosine * turned - factor * sine * across;
        table.slopesY[index] = sine * turned + factor * cosine * across;
    });
    return table;
}

} // namespace supple::surface::blend
