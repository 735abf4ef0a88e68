// Arithmetic must round as written: both faces at an edge make its samples of the same operands in the same order. The
// sums are those of docs/blend.md.
#include "cpu/blend.h"

#include "shaders/shared/blend.h"

#include <cmath>
#include <map>
#include <numbers>

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

/// eta and its slope.
template <class T>
glm::vec<2, T> hermite(T t) {
    return {(T(2) * t - T(3)) * t * t + T(1), T(6) * t * (t - T(1))};
}

/// Shorter than this against the face's two diagonals, squared, a normal is noise.
constexpr double kTinyNormal = 1e-12;

} // namespace

template <class T>
ChartCoefficients<T> coefficientsOf(const Mesh& mesh, std::span<const FitMatrix> matrices, uint32_t number,
                                    std::span<const glm::vec<3, T>> positions) {
    const Chart& chart = mesh.charts[number];
    const FitMatrix& matrix = matrices[chart.chartClass];
    const glm::vec<3, T> vertex = positions[chart.vertex];
    ChartCoefficients<T> c;
    for (uint32_t row = 0; row < kCoefficients; ++row) {
        glm::vec<3, T> sum(T(0));
        for (uint32_t i = 0; i < matrix.ringPoints; ++i) {
            sum += T(matrix.weight(row, i)) * (positions[mesh.ring[chart.firstRing + i]] - vertex);
        }
        c[row] = row == 0 ? vertex + sum : sum;
    }
    return c;
}

template <class T>
std::vector<ChartCoefficients<T>> construct(const Mesh& mesh, std::span<const glm::vec<3, T>> positions) {
    std::vector<FitMatrix> matrices;
    for (const ChartClass& chartClass : mesh.classes) {
        matrices.push_back(makeFitMatrix(chartClass));
    }
    std::vector<ChartCoefficients<T>> all;
    all.reserve(mesh.charts.size());
    for (uint32_t chart = 0; chart < mesh.charts.size(); ++chart) {
        all.push_back(coefficientsOf<T>(mesh, matrices, chart, positions));
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
        weights_.push_back(hermite(t));
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
ChartPoint<T> Evaluator<T>::tablePoint(uint32_t corner, uint32_t x, uint32_t y) const {
    const Corner& at = mesh_.corners[corner];
    const Table& table = tables_[tableOfClass_[mesh_.charts[at.chart].chartClass]];
    const uint32_t index = y * coordinateCount(rate_) + x;
    const Pair direction = table.directions[at.sector];
    // On a spoke both faces have the same radius and the same direction.
    const bool first = y == 0, second = x == 0;
    const Pair along = first ? direction : table.directions[at.sector + 1];
    ChartPoint<T> point;
    point.zeta = first    ? table.radii[x] * along
                 : second ? table.radii[y] * along
                          : product(table.points[index], direction);
    point.slope = product(table.slopes[index], direction);
    // T, which takes U's place where V has no part: U itself, or the parameter of the crease.
    point.t = point.zeta.x;
    point.tx = point.slope.x;
    point.ty = -point.slope.y;
    if (mesh_.classOf(at.chart).creased()) {
        point.t = first    ? parameters_[x] * along.x
                  : second ? parameters_[y] * along.x
                           : product(table.creasePoints[index], direction).x;
        point.tx = product(table.creaseSlopesX[index], direction).x;
        point.ty = product(table.creaseSlopesY[index], direction).x;
    }
    return point;
}

template <class T>
typename Evaluator<T>::Local Evaluator<T>::local(uint32_t corner, const ChartPoint<T>& at) const {
    const ChartCoefficients<T>& c = coefficients_[mesh_.corners[corner].chart];
    const T u = at.zeta.x, v = at.zeta.y, t = at.t;
    const Vec c0 = c[1] + u * (c[4] + u * c[7]); // of V, and of V^2
    const Vec c1 = c[2] + u * (c[5] + u * c[8]);
    const Vec dt = c[3] + T(2) * (t * c[6]);
    const Vec du = v * ((c[4] + T(2) * (u * c[7])) + v * (c[5] + T(2) * (u * c[8])));
    const Vec dv = c0 + T(2) * (v * c1);
    Local result;
    result.offset = t * (c[3] + t * c[6]) + v * (c0 + v * c1);
    result.dx = at.tx * dt + (at.slope.x * du + at.slope.y * dv);
    result.dy = at.ty * dt + (at.slope.x * dv - at.slope.y * du);
    return result;
}

template <class T>
typename Evaluator<T>::Views Evaluator<T>::views(uint32_t face, uint32_t i, uint32_t j) const {
    const uint32_t iBack = mirrored(rate_, i), jBack = mirrored(rate_, j);
    const std::array<std::array<uint32_t, 2>, 4> coordinates{{{i, j}, {j, iBack}, {iBack, jBack}, {jBack, i}}};
    Views views;
    for (uint32_t k = 0; k < 4; ++k) {
        const auto [x, y] = coordinates[k];
        views[k] = {tablePoint(4 * face + k, x, y), weights_[x], weights_[y]};
    }
    return views;
}

template <class T>
typename Evaluator<T>::Views Evaluator<T>::views(uint32_t face, const Pair& u, const Pair& v) const {
    const std::array<Pair, 4> coordinates{{{u.x, v.x}, {v.x, u.y}, {u.y, v.y}, {v.y, u.x}}};
    Views views;
    for (uint32_t k = 0; k < 4; ++k) {
        const Corner& at = mesh_.corners[4 * face + k];
        const ChartClass& chartClass = mesh_.classOf(at.chart);
        const std::vector<Pair>& directions = tables_[tableOfClass_[mesh_.charts[at.chart].chartClass]].directions;
        views[k] = {chartPoint<T>(coordinates[k], T(4) / T(chartClass.turns()), chartClass.creased(),
                                  directions[at.sector], directions[at.sector + 1]),
                    hermite(coordinates[k].x), hermite(coordinates[k].y)};
    }
    return views;
}

template <class T>
glm::vec<3, T> Evaluator<T>::vertex(uint32_t corner) const {
    return coefficients_[mesh_.corners[corner].chart][0];
}

template <class T>
typename Evaluator<T>::Blend Evaluator<T>::blend(uint32_t face, const Views& views) const {
    const uint32_t corner = 4 * face;
    std::array<Vec, 4> points, dx, dy;
    for (uint32_t k = 0; k < 4; ++k) {
        const auto& [point, x, y] = views[k];
        const Local at = local(corner + k, point);
        const T weight = x.x * y.x;
        points[k] = weight * (vertex(corner + k) + at.offset);
        // The slopes of the four weights add up to nothing, so that derivatives need not see coordinates.
        const Vec relative = (vertex(corner + k) - vertex(corner)) + at.offset;
        dx[k] = (x.y * y.x) * relative + weight * at.dx;
        dy[k] = (x.x * y.y) * relative + weight * at.dy;
    }
    Blend result;
    // Opposite corners together: on an edge one of the two is zero, and the sum reads the same from both faces.
    result.position = (points[0] + points[2]) + (points[1] + points[3]);
    result.du = (dx[0] - dx[2]) + (dy[3] - dy[1]);
    result.dv = (dy[0] - dy[2]) + (dx[1] - dx[3]);
    return result;
}

template <class T>
bool Evaluator<T>::isRegular(uint32_t face) const {
    for (uint32_t corner = 4 * face; corner < 4 * face + 4; ++corner) {
        const ChartClass& chartClass = mesh_.classOf(mesh_.corners[corner].chart);
        const bool isPlain = chartClass.kind == ChartKind::interior || chartClass.kind == ChartKind::boundary;
        if (!isPlain || chartClass.turns() != 4 || flatAcross(mesh_, corner)) {
            return false;
        }
    }
    return true;
}

template <class T>
typename Evaluator<T>::Blend Evaluator<T>::regular(uint32_t face, const Along& u, const Along& v) const {
    const Vec origin = vertex(4 * face);
    // A corner's coefficients of u^a v^b at 3 a + b, seen from the corner: u and v are its own x and y or, at odd
    // corners, y and x.
    std::array<ChartCoefficients<T>, 4> net;
    for (uint32_t k = 0; k < 4; ++k) {
        const Corner& at = mesh_.corners[4 * face + k];
        const ChartCoefficients<T>& c = coefficients_[at.chart];
        // U and V are x and y, turned by quarters.
        const bool swapped = at.sector % 2 == 1;
        const T x = at.sector == 2 || at.sector == 3 ? T(-1) : T(1),
                y = at.sector == 1 || at.sector == 2 ? T(-1) : T(1);
        for (uint32_t a = 0; a < 3; ++a) {
            for (uint32_t b = 0; b < 3; ++b) {
                const T sign = (a == 1 ? x : T(1)) * (b == 1 ? y : T(1));
                net[k][k % 2 == 0 ? 3 * a + b : 3 * b + a] = sign * c[swapped ? 3 * b + a : 3 * a + b];
            }
        }
        net[k][0] = net[k][0] - origin;
    }
    const auto quadratic = [](T t, const Vec& c0, const Vec& c1, const Vec& c2) { return c0 + t * (c1 + t * c2); };
    const auto slope = [](T t, const Vec& c1, const Vec& c2) { return c1 + T(2) * (t * c2); };
    // What corners give to a row: quadratics in the distance from its left and its right end, and their slopes by v.
    std::array<std::array<Vec, 3>, 2> row, across;
    for (uint32_t right = 0; right < 2; ++right) {
        const ChartCoefficients<T>&low = net[right == 0 ? 0 : 1], &high = net[right == 0 ? 3 : 2];
        for (uint32_t a = 0; a < 9; a += 3) {
            const Vec p = quadratic(v.t, low[a], low[a + 1], low[a + 2]);
            const Vec q = quadratic(v.back, high[a], high[a + 1], high[a + 2]);
            row[right][a / 3] = v.eta * p + v.etaBack * q;
            across[right][a / 3] = v.slope * (p - q) + v.eta * slope(v.t, low[a + 1], low[a + 2]) -
                                   v.etaBack * slope(v.back, high[a + 1], high[a + 2]);
        }
    }
    const Vec p = quadratic(u.t, row[0][0], row[0][1], row[0][2]),
              q = quadratic(u.back, row[1][0], row[1][1], row[1][2]);
    Blend result;
    result.position = origin + (u.eta * p + u.etaBack * q);
    result.du =
        u.slope * (p - q) + u.eta * slope(u.t, row[0][1], row[0][2]) - u.etaBack * slope(u.back, row[1][1], row[1][2]);
    result.dv = u.eta * quadratic(u.t, across[0][0], across[0][1], across[0][2]) +
                u.etaBack * quadratic(u.back, across[1][0], across[1][1], across[1][2]);
    return result;
}

template <class T>
bool Evaluator<T>::isTiny(uint32_t face, const Vec& normal) const {
    const Vec diagonal = vertex(4 * face + 2) - vertex(4 * face), other = vertex(4 * face + 3) - vertex(4 * face + 1);
    const T scale = dotProduct(diagonal, diagonal) * dotProduct(other, other);
    return !(dotProduct(normal, normal) > T(kTinyNormal) * scale);
}

/// Of unit length; the face's where there is none.
template <class T>
glm::vec<3, T> Evaluator<T>::unitNormal(uint32_t face, Vec n) const {
    if (isTiny(face, n)) {
        n = glm::cross(vertex(4 * face + 2) - vertex(4 * face), vertex(4 * face + 3) - vertex(4 * face + 1));
    }
    const T length = std::sqrt(dotProduct(n, n));
    return length > T(0) ? n / length : Vec(T(0));
}

template <class T>
glm::vec<3, T> Evaluator<T>::normal(uint32_t face, uint32_t i, uint32_t j, const Blend& at) const {
    const uint32_t corner = 4 * face;
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
    if (still || isTiny(face, n)) {
        const auto inside = [&](uint32_t k) {
            return k == 0 ? firstHalfStep(rate_) : k == rate_ ? lastHalfStep(rate_) : k;
        };
        const Blend near = blend(face, views(face, inside(i), inside(j)));
        n = glm::cross(near.du, near.dv);
    }
    return unitNormal(face, n);
}

template <class T>
Sample<T> Evaluator<T>::at(uint32_t face, uint32_t i, uint32_t j) const {
    Blend sample = blend(face, views(face, i, j));
    if (i > 0 && i < rate_ && j > 0 && j < rate_ && isRegular(face)) {
        const auto along = [&](uint32_t k) -> Along {
            return {parameters_[k], parameters_[rate_ - k], weights_[k].x, weights_[rate_ - k].x, weights_[k].y};
        };
        sample = regular(face, along(i), along(j));
    }
    return {sample.position, sample.du, sample.dv, normal(face, i, j, sample)};
}

template <class T>
Sample<T> Evaluator<T>::at(uint32_t face, const Pair& u, const Pair& v) const {
    Blend sample = blend(face, views(face, u, v));
    if (u.x > T(0) && u.y > T(0) && v.x > T(0) && v.y > T(0) && isRegular(face)) {
        const auto along = [](const Pair& pair) -> Along {
            return {pair.x, pair.y, hermite(pair.x).x, hermite(pair.y).x, hermite(pair.x).y};
        };
        sample = regular(face, along(u), along(v));
    }
    // Distances from the sides u = 0 and v = 0, and from the opposite ones; where the normal is taken.
    const T step = T(1) / T(shared::kStillSteps);
    Pair x = u, y = v;
    const auto keep = [&](T& from, T& rest, T distance) {
        from = distance;
        rest = T(1) - distance;
    };
    bool moved = false;
    for (uint32_t k = 0; k < 4; ++k) {
        T& from = k == 0 ? y.x : k == 1 ? x.y : k == 2 ? y.y : x.x;
        T& rest = k == 0 ? y.y : k == 1 ? x.x : k == 2 ? y.x : x.y;
        if (from < step && flatAcross(mesh_, 4 * face + k)) {
            keep(from, rest, step);
            moved = true;
        }
    }
    const Vec* chartOfCorner = nullptr;
    for (uint32_t k = 0; k < 4; ++k) {
        const bool right = k == 1 || k == 2, top = k >= 2;
        T &along = right ? x.y : x.x, &alongRest = right ? x.x : x.y;
        T &across = top ? y.y : y.x, &acrossRest = top ? y.x : y.y;
        const uint32_t chart = mesh_.corners[4 * face + k].chart;
        const ChartClass& chartClass = mesh_.classOf(chart);
        const T distance = std::max(along, across);
        const bool still = chartClass.kind == ChartKind::point || chartClass.kind == ChartKind::curve;
        if (distance == T(0) && !still) {
            chartOfCorner = coefficients_[chart].data();
        } else if (distance < step && (still || (chartClass.creased() && chartClass.turns() == 2))) {
            const T scale = distance > T(0) ? step / distance : T(0);
            keep(along, alongRest, distance > T(0) ? along * scale : step);
            keep(across, acrossRest, distance > T(0) ? across * scale : step);
            moved = true;
        }
    }
    Vec n = glm::cross(sample.du, sample.dv);
    if (chartOfCorner != nullptr) {
        n = glm::cross(chartOfCorner[3], chartOfCorner[1]);
    } else if (moved) {
        const Blend near = blend(face, views(face, x, y));
        n = glm::cross(near.du, near.dv);
    }
    return {sample.position, sample.du, sample.dv, unitNormal(face, n)};
}

namespace {

/// U, V and T of a chart at a corner's own (x, y).
struct ChartJets {
    Jet u, v, t;
};
ChartJets chartJets(const ChartClass& chartClass, uint32_t sector, const Jet& x, const Jet& y) {
    const double stretch = 4.0 / chartClass.turns();
    const double turn = 2.0 * std::numbers::pi * sector / chartClass.turns();
    if (stretch == 1.0) {
        const double c = std::cos(turn), s = std::sin(turn);
        const Jet u = c * x - s * y, v = s * x + c * y;
        return {u, v, u};
    }
    const Jet square = x * x + y * y;
    const Jet phi = stretch * angleOf(x, y) + turn;
    const Jet radius = power(square, 0.5 * stretch);
    const Jet u = radius * cosineOf(phi);
    return {u, radius * sineOf(phi), chartClass.creased() ? power(square, 0.5) * cosineOf(phi) : u};
}

Jet hermiteJet(const Jet& t) {
    return ((2.0 * t + -3.0) * (t * t)) + 1.0;
}

/// Calls add(chart, coefficient, weight) for all that a point of a face is made of.
template <class Add>
void forEachWeight(const Mesh& mesh, uint32_t face, double u, double v, Add&& add) {
    const Jet s = Jet::first(u), r = Jet::second(v);
    const std::array<std::array<Jet, 2>, 4> views{{{s, r}, {r, 1.0 - s}, {1.0 - s, 1.0 - r}, {1.0 - r, s}}};
    for (uint32_t k = 0; k < 4; ++k) {
        const Corner& corner = mesh.corners[4 * face + k];
        const Jet weight = hermiteJet(views[k][0]) * hermiteJet(views[k][1]);
        add(corner.chart, 0, weight);
        const ChartClass& chartClass = mesh.classOf(corner.chart);
        if (chartClass.kind == ChartKind::point) {
            continue;
        }
        const auto [zetaU, zetaV, t] = chartJets(chartClass, corner.sector, views[k][0], views[k][1]);
        const Jet vv = zetaV * zetaV;
        const std::array<Jet, kCoefficients> basis = {Jet::constant(0.0), zetaV,      vv,    t,
                                                      zetaU * zetaV,      zetaU * vv, t * t, zetaU * zetaU * zetaV,
                                                      zetaU * zetaU * vv};
        for (uint32_t a = 1; a < kCoefficients; ++a) {
            add(corner.chart, a, weight * basis[a]);
        }
    }
}

} // namespace

SurfaceJet evaluateJet(const Mesh& mesh, std::span<const ChartCoefficients<double>> coefficients, uint32_t face,
                       double u, double v) {
    SurfaceJet sum;
    const glm::dvec3 origin = coefficients[mesh.corners[4 * size_t{face}].chart][0];
    forEachWeight(mesh, face, u, v, [&](uint32_t chart, uint32_t a, const Jet& weight) {
        sum.add(a == 0 ? coefficients[chart][0] - origin : coefficients[chart][a], weight);
    });
    sum.position += origin;
    return sum;
}

void weighCoefficient(const Mesh& mesh, std::span<const FitMatrix> matrices, uint32_t number, uint32_t coefficient,
                      const cpu::VertexWeight& weight, cpu::PointWeights& out) {
    const Chart& chart = mesh.charts[number];
    const FitMatrix& matrix = matrices[chart.chartClass];
    double vertex = coefficient == 0 ? 1.0 : 0.0;
    const auto add = [&](uint32_t of, double factor) {
        cpu::VertexWeight own = factor * weight;
        own.vertex = of;
        out.add(own);
    };
    for (uint32_t i = 0; i < matrix.ringPoints; ++i) {
        const double factor = matrix.weight(coefficient, i);
        if (factor != 0.0) {
            add(mesh.ring[chart.firstRing + i], factor);
            vertex -= factor;
        }
    }
    add(chart.vertex, vertex);
}

void weighJet(const Mesh& mesh, std::span<const FitMatrix> matrices, uint32_t face, double u, double v,
              cpu::PointWeights& out) {
    forEachWeight(mesh, face, u, v, [&](uint32_t chart, uint32_t a, const Jet& weight) {
        weighCoefficient(mesh, matrices, chart, a, {0, weight.value, weight.x, weight.y}, out);
    });
}

template ChartCoefficients<double> coefficientsOf<double>(const Mesh&, std::span<const FitMatrix>, uint32_t,
                                                          std::span<const glm::dvec3>);
template std::vector<ChartCoefficients<float>> construct<float>(const Mesh&, std::span<const glm::vec3>);
template std::vector<ChartCoefficients<double>> construct<double>(const Mesh&, std::span<const glm::dvec3>);
template class Evaluator<float>;
template class Evaluator<double>;

} // namespace supple::surface::blend
