#include "runtime/queries/piece_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace supple::runtime {
namespace {

using Coefficients = std::array<double, shared::kPieceCoefficients>;

/// Calls visit(k, place) for the points that a polynomial goes through, in the order of its coefficients.
template <class F>
void forPoints(bool isSquare, F&& visit) {
    const uint32_t along = isSquare ? 3 : 4;
    size_t k = 0;
    for (uint32_t j = 0; j <= along; ++j) {
        for (uint32_t i = 0; i <= (isSquare ? along : along - j); ++i) {
            visit(k++, glm::dvec2(i, j) / static_cast<double>(along));
        }
    }
}

/// What coefficients have of a place.
Coefficients basisAt(bool isSquare, const glm::dvec2& at) {
    Coefficients basis{};
    if (isSquare) {
        const auto cubic = [](double x) {
            const double y = 1.0 - x;
            return std::array{y * y * y, 3.0 * y * y * x, 3.0 * y * x * x, x * x * x};
        };
        const std::array<double, 4> u = cubic(at.x), v = cubic(at.y);
        for (size_t k = 0; k < basis.size(); ++k) {
            basis[k] = u[k % 4] * v[k / 4];
        }
        return basis;
    }
    constexpr std::array<double, 5> kFactorials{1.0, 1.0, 2.0, 6.0, 24.0};
    size_t k = 0;
    for (size_t j = 0; j <= 4; ++j) {
        for (size_t i = 0; i + j <= 4; ++i) {
            const size_t rest = 4 - i - j;
            basis[k++] = 24.0 / (kFactorials[i] * kFactorials[j] * kFactorials[rest]) * std::pow(at.x, i) *
                         std::pow(at.y, j) * std::pow(1.0 - at.x - at.y, rest);
        }
    }
    return basis;
}

/// Values of a cubic at thirds become its Bezier coefficients.
void toCubic(double& a, double& b, double& c, double& d) {
    const double first = (-5.0 * a + 18.0 * b - 9.0 * c + 2.0 * d) / 6.0;
    c = (2.0 * a - 9.0 * b + 18.0 * c - 5.0 * d) / 6.0;
    b = first;
}

/// Where the polynomial is compared with the surface.
constexpr std::array<glm::dvec2, 4> kSquareChecks{
    {{0.5, 0.5}, {1.0 / 6, 5.0 / 6}, {5.0 / 6, 1.0 / 2}, {1.0 / 6, 1.0 / 6}}};
constexpr std::array<glm::dvec2, 4> kTriangleChecks{{{0.375, 0.375}, {0.125, 0.625}, {0.625, 0.125}, {0.125, 0.125}}};

} // namespace

PieceFitter::PieceFitter(const CpuGroup& group) : group_(group), numbers_(group.cage().vertexCount()) {
    // The inverse of the basis at the points, by Gauss and Jordan.
    std::array<std::array<double, 2 * kQuartic>, kQuartic> rows{};
    forPoints(false, [&](size_t r, const glm::dvec2& at) {
        const Coefficients basis = basisAt(false, at);
        std::copy_n(basis.begin(), kQuartic, rows[r].begin());
        rows[r][kQuartic + r] = 1.0;
    });
    for (size_t column = 0; column < kQuartic; ++column) {
        size_t pivot = column;
        for (size_t r = column + 1; r < kQuartic; ++r) {
            pivot = std::abs(rows[r][column]) > std::abs(rows[pivot][column]) ? r : pivot;
        }
        std::swap(rows[pivot], rows[column]);
        const double factor = 1.0 / rows[column][column];
        for (double& x : rows[column]) {
            x *= factor;
        }
        for (size_t r = 0; r < kQuartic; ++r) {
            for (size_t c = 2 * kQuartic; r != column && c-- > column;) {
                rows[r][c] -= rows[r][column] * rows[column][c];
            }
        }
    }
    for (size_t r = 0; r < kQuartic; ++r) {
        std::copy_n(rows[r].begin() + kQuartic, kQuartic, toQuartic_[r].begin());
    }
}

const std::vector<PieceFitter::Weight>& PieceFitter::weightsAt(const FacePart& part, const glm::dvec2& at) {
    if (face_ != part.face) {
        face_ = part.face;
        known_.clear();
    }
    const SuppleSurfacePoint point = part.at(at);
    std::vector<Weight>& own = known_[{static_cast<float>(point.side), point.a, point.b}];
    if (!own.empty()) {
        return own;
    }
    const CpuGroup::Found found = group_.find(point);
    const CpuGroup::Part& of = group_.parts()[found.part];
    weights_.clear();
    of.surface->weigh(found.place.place, weights_);
    own.reserve(weights_.entries().size());
    for (const cpu::VertexWeight& entry : weights_.entries()) {
        own.push_back({of.piece != nullptr ? of.piece->of.vertices[entry.vertex] : entry.vertex, entry.position});
    }
    return own;
}

Coefficients PieceFitter::coefficientsOf(bool isSquare, const Coefficients& values) const {
    Coefficients out = values;
    if (isSquare) {
        for (size_t k = 0; k < 4; ++k) {
            toCubic(out[4 * k], out[4 * k + 1], out[4 * k + 2], out[4 * k + 3]);
        }
        for (size_t k = 0; k < 4; ++k) {
            toCubic(out[k], out[4 + k], out[8 + k], out[12 + k]);
        }
        return out;
    }
    for (size_t r = 0; r < kQuartic; ++r) {
        out[r] = 0.0;
        for (size_t c = 0; c < kQuartic; ++c) {
            out[r] += toQuartic_[r][c] * values[c];
        }
    }
    return out;
}

double PieceFitter::errorOf(const FacePart& part, const PieceFit& fit) {
    double error = 0.0;
    for (const glm::dvec2& at : part.isSquare ? kSquareChecks : kTriangleChecks) {
        numbers_.clear();
        differences_.clear();
        const auto add = [&](uint32_t vertex, double share) {
            const uint32_t number = numbers_.of(vertex);
            differences_.resize(std::max<size_t>(differences_.size(), number + size_t{1}), 0.0);
            differences_[number] += share;
        };
        for (const Weight& weight : weightsAt(part, at)) {
            add(weight.vertex, weight.share);
        }
        const Coefficients basis = basisAt(part.isSquare, at);
        for (const VertexShares& own : fit.vertices) {
            add(own.vertex, -std::inner_product(basis.begin(), basis.end(), own.of.begin(), 0.0));
        }
        double sum = 0.0;
        for (const double difference : differences_) {
            sum += std::abs(difference);
        }
        error = std::max(error, sum);
    }
    return error;
}

PieceFit PieceFitter::fit(const FacePart& part) {
    PieceFit fit;
    numbers_.clear();
    forPoints(part.isSquare, [&](size_t k, const glm::dvec2& at) {
        for (const Weight& weight : weightsAt(part, at)) {
            const uint32_t number = numbers_.of(weight.vertex);
            if (number == fit.vertices.size()) {
                fit.vertices.push_back({weight.vertex, {}});
            }
            fit.vertices[number].of[k] += weight.share;
        }
    });
    for (VertexShares& own : fit.vertices) {
        own.of = coefficientsOf(part.isSquare, own.of);
    }
    fit.error = errorOf(part, fit);
    return fit;
}

} // namespace supple::runtime
