// Arithmetic must round as written: both faces at an edge make its samples of the same operands in the same order. The
// sums are those of docs/blend.md.
#include "surface/blend/reference.h"

#include <cmath>
#include <map>

namespace supple::surface::blend {
namespace {

template <class T>
T dotProduct(const glm::vec<3, T>& a, const glm::vec<3, T>& b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

template <class T>
std::vector<glm::vec<2, T>> rounded(const std::vector<glm::dvec2>& values) {
    return {values.begin(), values.end()};
}

template <class T>
glm::vec<2, T> product(const glm::vec<2, T>& a, const glm::vec<2, T>& b) {
    return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}

/// Shorter than this against the face's two diagonals, squared, a normal is noise.
constexpr double kTinyNormal = 1e-12;

} // namespace

template <class T>
std::vector<ChartCoefficients<T>> construct(const Mesh& mesh, std::span<const glm::vec<3, T>> positions) {
    std::vector<FitMatrix> matrices;
    for (const ChartClass& chartClass : mesh.classes) {
        matrices.push_back(makeFitMatrix(chartClass));
    }
    std::vector<ChartCoefficients<T>> all;
    all.reserve(mesh.charts.size());
    for (const Chart& chart : mesh.charts) {
        const FitMatrix& matrix = matrices[chart.chartClass];
        const glm::vec<3, T> vertex = positions[chart.vertex];
        ChartCoefficients<T>& c = all.emplace_back();
        for (uint32_t row = 0; row < kCoefficients; ++row) {
            glm::vec<3, T> sum(T(0));
            for (uint32_t i = 0; i < matrix.ringPoints; ++i) {
                sum += T(matrix.weight(row, i)) * (positions[mesh.ring[chart.firstRing + i]] - vertex);
            }
            c[row] = row == 0 ? vertex + sum : sum;
        }
    }
    return all;
}

template <class T>
Evaluator<T>::Evaluator(const Mesh& mesh, std::span<const ChartCoefficients<T>> coefficients, uint32_t rate)
    : mesh_(mesh), coefficients_(coefficients), rate_(rate) {
    for (uint32_t i = 0; i < coordinateCount(rate); ++i) {
        const Coordinate c = coordinateAt(rate, i);
        const T t = T(c.numerator) / T(c.denominator);
        parameters_.push_back(t);
        weights_.push_back((T(2) * t - T(3)) * t * t + T(1));
        weightSlopes_.push_back(T(6) * t * (t - T(1)));
    }
    std::map<uint32_t, uint32_t> byTurns;
    for (const ChartClass& chartClass : mesh.classes) {
        const uint32_t turns = chartClass.turns();
        const auto [known, isNew] = byTurns.try_emplace(turns, static_cast<uint32_t>(tables_.size()));
        tableOfClass_.push_back(known->second);
        Table& table = isNew ? tables_.emplace_back() : tables_[known->second];
        if (isNew) {
            const ChartTable chart = makeChartTable(turns, rate);
            table.directions = rounded<T>(chart.directions);
            table.radii.assign(chart.radii.begin(), chart.radii.end());
            table.points = rounded<T>(chart.points);
            table.slopes = rounded<T>(chart.slopes);
        }
        if (chartClass.creased() && table.creasePoints.empty()) {
            const CreaseTable crease = makeCreaseTable(turns, rate);
            table.creasePoints = rounded<T>(crease.points);
            table.creaseSlopesX = rounded<T>(crease.slopesX);
            table.creaseSlopesY = rounded<T>(crease.slopesY);
        }
    }
}

template <class T>
typename Evaluator<T>::Local Evaluator<T>::local(uint32_t corner, uint32_t x, uint32_t y) const {
    const Corner& at = mesh_.corners[corner];
    const ChartClass& chartClass = mesh_.classOf(at.chart);
    const ChartCoefficients<T>& c = coefficients_[at.chart];
    const Table& table = tables_[tableOfClass_[mesh_.charts[at.chart].chartClass]];
    const uint32_t index = y * coordinateCount(rate_) + x;
    const Pair direction = table.directions[at.sector];
    // On a spoke both faces have the same radius and the same direction.
    const bool first = y == 0, second = x == 0;
    const Pair along = first ? direction : table.directions[at.sector + 1];
    const Pair zeta = first    ? table.radii[x] * along
                      : second ? table.radii[y] * along
                               : product(table.points[index], direction);
    const Pair slope = product(table.slopes[index], direction);
    const T u = zeta.x, v = zeta.y;
    // T, which takes U's place where V has no part: U itself, or the parameter of the crease.
    T t = u, tx = slope.x, ty = -slope.y;
    if (chartClass.creased()) {
        t = first    ? parameters_[x] * along.x
            : second ? parameters_[y] * along.x
                     : product(table.creasePoints[index], direction).x;
        tx = product(table.creaseSlopesX[index], direction).x;
        ty = product(table.creaseSlopesY[index], direction).x;
    }
    const Vec c0 = c[1] + u * (c[4] + u * c[7]); // of V, and of V^2
    const Vec c1 = c[2] + u * (c[5] + u * c[8]);
    const Vec dt = c[3] + T(2) * (t * c[6]);
    const Vec du = v * ((c[4] + T(2) * (u * c[7])) + v * (c[5] + T(2) * (u * c[8])));
    const Vec dv = c0 + T(2) * (v * c1);
    Local result;
    result.offset = t * (c[3] + t * c[6]) + v * (c0 + v * c1);
    result.dx = tx * dt + (slope.x * du + slope.y * dv);
    result.dy = ty * dt + (slope.x * dv - slope.y * du);
    return result;
}

template <class T>
typename Evaluator<T>::Blend Evaluator<T>::blend(uint32_t face, uint32_t i, uint32_t j) const {
    const uint32_t corner = 4 * face;
    const uint32_t iBack = mirrored(rate_, i), jBack = mirrored(rate_, j);
    const std::array<std::array<uint32_t, 2>, 4> coordinates{{{i, j}, {j, iBack}, {iBack, jBack}, {jBack, i}}};
    const Vec origin = coefficients_[mesh_.corners[corner].chart][0];
    std::array<Vec, 4> points, dx, dy;
    for (uint32_t k = 0; k < 4; ++k) {
        const auto [x, y] = coordinates[k];
        const Local at = local(corner + k, x, y);
        const Vec base = coefficients_[mesh_.corners[corner + k].chart][0];
        const T weight = weights_[x] * weights_[y];
        points[k] = weight * (base + at.offset);
        // The slopes of the four weights add up to nothing, so that derivatives need not see coordinates.
        const Vec relative = (base - origin) + at.offset;
        dx[k] = (weightSlopes_[x] * weights_[y]) * relative + weight * at.dx;
        dy[k] = (weights_[x] * weightSlopes_[y]) * relative + weight * at.dy;
    }
    Blend result;
    // Opposite corners together: on an edge one of the two is zero, and the sum reads the same from both faces.
    result.position = (points[0] + points[2]) + (points[1] + points[3]);
    result.du = (dx[0] - dx[2]) + (dy[3] - dy[1]);
    result.dv = (dy[0] - dy[2]) + (dx[1] - dx[3]);
    return result;
}

template <class T>
glm::vec<3, T> Evaluator<T>::normal(uint32_t face, uint32_t i, uint32_t j, const Blend& at) const {
    const uint32_t corner = 4 * face;
    const auto vertex = [&](uint32_t k) { return coefficients_[mesh_.corners[corner + k].chart][0]; };
    const Vec diagonal = vertex(2) - vertex(0), otherDiagonal = vertex(3) - vertex(1);
    const T scale = dotProduct(diagonal, diagonal) * dotProduct(otherDiagonal, otherDiagonal);
    const auto isTiny = [&](const Vec& n) { return !(dotProduct(n, n) > T(kTinyNormal) * scale); };
    // The edge from corner k to the next one that the sample lies on.
    const std::array<bool, 4> onEdge{j == 0, i == rate_, j == rate_, i == 0};
    bool still = false; // by connectivity, so that it does not hang on rounding
    Vec n = glm::cross(at.du, at.dv);
    for (uint32_t k = 0; k < 4; ++k) {
        still = still || (onEdge[k] && flatAcross(mesh_, corner + k));
        if (onEdge[k] && onEdge[(k + 3) % 4]) { // at the corner itself
            const uint32_t chart = mesh_.corners[corner + k].chart;
            const ChartKind kind = mesh_.classOf(chart).kind;
            still = still || kind == ChartKind::point || kind == ChartKind::curve;
            n = glm::cross(coefficients_[chart][3], coefficients_[chart][1]);
        }
    }
    if (still || isTiny(n)) {
        const auto inside = [&](uint32_t k) {
            return k == 0 ? firstHalfStep(rate_) : k == rate_ ? lastHalfStep(rate_) : k;
        };
        const Blend near = blend(face, inside(i), inside(j));
        n = glm::cross(near.du, near.dv);
    }
    if (isTiny(n)) {
        n = glm::cross(diagonal, otherDiagonal);
    }
    const T length = std::sqrt(dotProduct(n, n));
    return length > T(0) ? n / length : Vec(T(0));
}

template <class T>
Sample<T> Evaluator<T>::at(uint32_t face, uint32_t i, uint32_t j) const {
    const Blend sample = blend(face, i, j);
    return {sample.position, sample.du, sample.dv, normal(face, i, j, sample)};
}

template std::vector<ChartCoefficients<float>> construct<float>(const Mesh&, std::span<const glm::vec3>);
template std::vector<ChartCoefficients<double>> construct<double>(const Mesh&, std::span<const glm::dvec3>);
template class Evaluator<float>;
template class Evaluator<double>;

} // namespace supple::surface::blend
