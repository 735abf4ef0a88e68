#include "cpu/loop.h"

#include "cpu/fragment.h"

#include <array>
#include <cmath>

namespace supple::surface::loop {
namespace {

using subdivision::Fan;
using subdivision::Fragment;
using subdivision::LevelNet;
using subdivision::LimitShape;

constexpr int kMostLevels = 40;

/// A point of the triangular lattice: steps along the directions of corners 1 and 2.
struct Place {
    int32_t a = 0, b = 0;
};
Place operator+(const Place& x, const Place& y) {
    return {x.a + y.a, x.b + y.b};
}
Place scaled(int32_t s, const Place& x) {
    return {s * x.a, s * x.b};
}

/// Each line through a corner of a facet has two points on its far side; with them, the triangles they mirror. The
/// first lies beside the corner before, the second beside the one behind.
struct Mirror {
    uint32_t line;
    Place own, end, otherEnd, mirrored;
};
constexpr std::array<Mirror, 6> kMirrors = {{{0, {-1, 0}, {0, 0}, {-1, 1}, {0, 1}},
                                             {0, {0, -1}, {0, 0}, {1, -1}, {1, 0}},
                                             {1, {2, -1}, {1, 0}, {1, -1}, {0, 0}},
                                             {1, {2, 0}, {1, 0}, {1, 1}, {0, 1}},
                                             {2, {0, 2}, {0, 1}, {1, 1}, {1, 0}},
                                             {2, {-1, 2}, {0, 1}, {-1, 1}, {0, 0}}}};

/// The points of a fragment by their places. What lies across a crease is the mirror image of what lies on this side:
/// the point that makes a parallelogram with the triangle at the crease.
class Lattice {
public:
    Lattice(const LevelNet& net, const Fan& fan, uint32_t sector)
        : points_(net.points()), fan_(fan), sector_(sector),
          facet_(false), sharpness_{net.sharpnessOf(sector),
                                    net.sharpnessOf((sector + 1) % (fan.sectors + (fan.open ? 1 : 0))), 0.0f},
          sharp_{sharpness_[0] > 0.0f, sharpness_[1] > 0.0f, false} {}
    explicit Lattice(const LevelNet& net)
        : points_(net.points()), facet_(true), sharpness_{net.sharpnessOf(0), net.sharpnessOf(1), net.sharpnessOf(2)},
          sharp_{sharpness_[0] > 0.0f, sharpness_[1] > 0.0f, sharpness_[2] > 0.0f} {}

    /// The sharpness of semi-sharp creases alone: of the two spokes beside a sector, or of a facet's three lines.
    [[nodiscard]] float semiSharp(size_t line) const {
        return sharpness_[line] < kInfiniteSharpness ? sharpness_[line] : 0.0f;
    }
    /// What the two points beside a segment of a crease are more than its ends, which the mirror images make up. Both
    /// points beside it must be there.
    [[nodiscard]] glm::dvec3 excess(const Place& begin, const Place& end, const Place& one, const Place& other) const {
        return stored(one) + stored(other) - stored(begin) - stored(end);
    }

    [[nodiscard]] glm::dvec3 at(const Place& p) const {
        if (!facet_) {
            return inSector(p);
        }
        for (const Mirror& m : kMirrors) {
            if (sharp_[m.line] && m.own.a == p.a && m.own.b == p.b) {
                return stored(m.end) + stored(m.otherEnd) - stored(m.mirrored);
            }
        }
        return stored(p);
    }

private:
    [[nodiscard]] glm::dvec3 inSector(const Place& p) const {
        if (p.b < 0 && sharp_[0]) {
            return stored({p.a - 1, 0}) + stored({p.a, 0}) - stored({p.a - 1, 1});
        }
        if (p.a < 0 && sharp_[1]) {
            return stored({0, p.b - 1}) + stored({0, p.b}) - stored({1, p.b - 1});
        }
        return stored(p);
    }
    [[nodiscard]] const glm::dvec3& stored(const Place& p) const {
        return points_[facet_ ? subdivision::facetPointIndex(1, p.a, p.b) : pointIndex(fan_, sector_, p.a, p.b)];
    }

    std::span<const glm::dvec3> points_;
    Fan fan_;
    uint32_t sector_ = 0;
    bool facet_;
    std::array<float, 3> sharpness_;
    std::array<bool, 3> sharp_; ///< spokes on both sides of the sector, or lines of the facet
};

/// The box spline over a triangle of the lattice, whose corner 0 lies at `origin`. With x and y the weights of corners
/// 1 and 2, in powers of these.
Point boxSpline(const Lattice& lattice, const Place& origin, int32_t orientation, double x, double y) {
    const glm::dvec3 centre = lattice.at(origin);
    const auto p = [&](int32_t a, int32_t b) { return lattice.at(origin + scaled(orientation, {a, b})) - centre; };
    const glm::dvec3 e1 = p(1, 0), e2 = p(0, 1), e3 = p(-1, 1), e4 = p(-1, 0), e5 = p(0, -1), e6 = p(1, -1);
    const glm::dvec3 far1 = p(2, -1), far2 = p(2, 0), far3 = p(1, 1), far4 = p(0, 2), far5 = p(-1, 2);
    const std::array<std::array<glm::dvec3, 5>, 5> c = {{
        {{(e1 + e2 + e3 + e4 + e5 + e6) / 12.0, (2.0 * (e2 - e5) + e1 + e3 - e4 - e6) / 6.0, (e2 + e5) / 2.0,
          (e4 + e6 + far5 + far3 - 2.0 * (e1 + e2 + e3 + e5)) / 6.0,
          (e5 + far4 - e2 + 2.0 * (e1 + e3) - e4 - e6 - far5 - far3) / 12.0}},
        {{(2.0 * (e1 - e4) + e2 + e6 - e3 - e5) / 6.0, (e1 + e2 + e4 + e5 - e3 - e6) / 2.0,
          (e6 + far3 - e2 - e5) / 2.0 - e1, (e5 + far4 - e2 + 2.0 * (e1 + e3) - e4 - e6 - far5 - far3) / 6.0}},
        {{(e1 + e4) / 2.0, (e3 + far3 - e1 - e4) / 2.0 - e2}},
        {{(e5 + e3 + far1 + far3 - 2.0 * (e1 + e2 + e4 + e6)) / 6.0,
          (e4 + far2 - e1 + 2.0 * (e2 + e6) - e3 - e5 - far1 - far3) / 6.0}},
        {{(e4 + far2 - e1 + 2.0 * (e2 + e6) - e3 - e5 - far1 - far3) / 12.0}},
    }};
    Point point;
    point.position = centre;
    const std::array<double, 5> xs{1.0, x, x * x, x * x * x, x * x * x * x};
    const std::array<double, 5> ys{1.0, y, y * y, y * y * y, y * y * y * y};
    for (size_t m = 0; m <= 4; ++m) {
        for (size_t n = 0; m + n <= 4; ++n) {
            const glm::dvec3& own = c[m][n];
            const auto dm = static_cast<double>(m), dn = static_cast<double>(n);
            point.position += own * (xs[m] * ys[n]);
            point.du += m == 0 ? glm::dvec3(0.0) : own * (dm * xs[m - 1] * ys[n]);
            point.dv += n == 0 ? glm::dvec3(0.0) : own * (dn * xs[m] * ys[n - 1]);
            point.duu += m < 2 ? glm::dvec3(0.0) : own * (dm * (dm - 1.0) * xs[m - 2] * ys[n]);
            point.duv += m == 0 || n == 0 ? glm::dvec3(0.0) : own * (dm * dn * xs[m - 1] * ys[n - 1]);
            point.dvv += n < 2 ? glm::dvec3(0.0) : own * (dn * (dn - 1.0) * xs[m] * ys[n - 2]);
        }
    }
    return point;
}

Point fromJet(const SurfaceJet& s) {
    return {s.position, s.du, s.dv, {}, s.duu, s.duv, s.dvv};
}

/// The excess of three segments of a crease that follow each other.
using Excess = std::array<glm::dvec3, 3>;

/// The excess on a half of the second segment after a sharp step, which refines it as quadratic B-splines and halves
/// it.
Excess afterSharpStep(const Excess& s, bool secondHalf) {
    const auto between = [](const glm::dvec3& near, const glm::dvec3& far) { return (3.0 * near + far) / 8.0; };
    return secondHalf ? Excess{between(s[1], s[0]), between(s[1], s[2]), between(s[2], s[1])}
                      : Excess{between(s[0], s[1]), between(s[1], s[0]), between(s[1], s[2])};
}

/// What the points across a smooth line with this excess add to the box spline: at x along the second segment and y
/// from the line. Derivatives in x and y.
Point smoothExcess(const Excess& s, double x, double y) {
    Point point;
    const auto add = [&](const glm::dvec3& excess, const Jet& weight) {
        SurfaceJet sum = point.jet();
        sum.add(excess, (1.0 / 12.0) * weight);
        point = fromJet(sum);
    };
    if (y >= 1.0) {
        return point;
    }
    const Jet v = Jet::first(x), w = Jet::second(y);
    if (x + y > 1.0) { // the triangle that touches the line at the segment's end
        const Jet a = 1.0 - w, aaa = a * a * a;
        add(s[1], a * aaa + 2.0 * (aaa * (1.0 - v)));
        add(s[2], a * aaa + 2.0 * (aaa * ((v + w) + -1.0)));
        return point;
    }
    const Jet u = (1.0 - v) - w, uu = u * u, vv = v * v;
    add(s[0], uu * uu + 2.0 * (u * uu * v));
    add(s[2], vv * vv + 2.0 * (v * vv * u));
    const Jet both = uu * uu + vv * vv + 6.0 * (u * v * (uu + vv)) + 12.0 * (uu * vv);
    const Jet beside = 2.0 * (u * uu + v * vv) + 6.0 * (u * v * (u + v));
    add(s[1], both + w * beside);
    return point;
}

/// The same where the first `steps` steps are sharp.
Point excessAfter(Excess s, uint32_t steps, double x, double y) {
    for (uint32_t step = 0; step < steps && y < 1.0; ++step) {
        const bool secondHalf = x >= 0.5;
        s = afterSharpStep(s, secondHalf);
        x = 2.0 * x - (secondHalf ? 1.0 : 0.0);
        y *= 2.0;
    }
    Point point = smoothExcess(s, x, y);
    const double scale = std::exp2(steps);
    point.du *= scale, point.dv *= scale;
    catmull_clark::turnSecondDerivatives({scale, 0.0}, {0.0, scale}, point);
    return point;
}

/// The same at a sharpness, whose last step is partly sharp.
Point creaseExcess(const Excess& s, float sharpness, double x, double y) {
    if (sharpness <= 0.0f) {
        return {};
    }
    const auto steps = static_cast<uint32_t>(sharpness);
    const double part = static_cast<double>(sharpness) - steps;
    const Point few = excessAfter(s, steps, x, y), more = excessAfter(s, steps + 1, x, y);
    return {glm::mix(few.position, more.position, part),
            glm::mix(few.du, more.du, part),
            glm::mix(few.dv, more.dv, part),
            {},
            glm::mix(few.duu, more.duu, part),
            glm::mix(few.duv, more.duv, part),
            glm::mix(few.dvv, more.dvv, part)};
}

/// Adds a crease to a point, given the derivatives of `x` and `y` of the crease in those of the point.
void addCrease(const Point& crease, const glm::dvec2& x, const glm::dvec2& y, Point& point) {
    point.position += crease.position;
    point.du += x.x * crease.du + y.x * crease.dv;
    point.dv += x.y * crease.du + y.y * crease.dv;
    Point turned = crease;
    catmull_clark::turnSecondDerivatives({x.x, y.x}, {x.y, y.y}, turned);
    point.duu += turned.duu, point.duv += turned.duv, point.dvv += turned.dvv;
}

/// What the two spokes beside a sector add at (x, y), steps along them.
void addSpokes(const Lattice& lattice, double x, double y, Point& point) {
    const auto excessOf = [&](bool second, int32_t i) {
        const auto place = [&](int32_t a, int32_t b) { return second ? Place{b, a} : Place{a, b}; };
        return lattice.excess(place(i, 0), place(i + 1, 0), place(i, 1), place(i + 1, -1));
    };
    for (const bool second : {false, true}) {
        const float sharpness = lattice.semiSharp(second ? 1 : 0);
        const double along = second ? y : x, across = second ? x : y;
        if (sharpness <= 0.0f || across >= 1.0) {
            continue;
        }
        const Excess near = {glm::dvec3(0.0), excessOf(second, 0), excessOf(second, 1)};
        const Point crease = along >= 1.0
                                 ? creaseExcess({near[1], near[2], excessOf(second, 2)}, sharpness, along - 1.0, across)
                                 : creaseExcess(near, sharpness, along, across);
        const glm::dvec2 first(1.0, 0.0), other(0.0, 1.0);
        addCrease(crease, second ? other : first, second ? first : other, point);
    }
}

} // namespace

namespace {

/// The corner that has more than half of the weight, or 3: the middle.
uint32_t cornerAt(const std::array<double, 3>& weights) {
    uint32_t corner = 0;
    while (corner < 3 && weights[corner] <= 0.5) {
        ++corner;
    }
    return corner;
}

} // namespace

subdivision::SectorLevel LimitSurface::levelAt(const LimitShape& shape, uint32_t triangle, double v, double w) {
    const std::array<double, 3> weights = {1.0 - v - w, v, w};
    const uint32_t corner = cornerAt(weights);
    const LimitShape::Sector& sector = shape.sectors()[4 * size_t{triangle} + corner];
    if (corner == 3) {
        return {sector, 1};
    }
    if (shape.isUniform(sector.fragment)) {
        return {sector, 2};
    }
    const double distance = weights[(corner + 1) % 3] + weights[(corner + 2) % 3];
    if (distance < std::exp2(-kMostLevels)) {
        return {sector, 0};
    }
    int exponent = 0;
    std::frexp(distance, &exponent);
    return {sector, static_cast<uint32_t>(std::max(1 - exponent, 2))}; // 2^-level <= distance < 2^(1 - level)
}

Point LimitSurface::at(uint32_t triangle, double v, double w) const {
    const subdivision::SectorLevel at = levelAt(pose_->shape(), triangle, v, w);
    return at.level == 0 ? catmull_clark::limitAtCentre(*pose_, at.sector)
                         : on({*pose_, at.sector.fragment, at.level}, at.sector, v, w);
}

Point LimitSurface::on(const LevelNet& net, const LimitShape::Sector& sector, double v, double w) {
    const std::array<double, 3> weights = {1.0 - v - w, v, w};
    const uint32_t corner = cornerAt(weights);
    Point point = corner == 3 ? inMiddle(net, 1.0 - 2.0 * weights[0], 1.0 - 2.0 * weights[1])
                              : atDistance(net, sector.number, weights[(corner + 1) % 3], weights[(corner + 2) % 3]);
    const glm::dvec3 a = point.du, b = point.dv;
    const std::array<std::array<glm::dvec3, 2>, 4> derivatives = {
        {{a, b}, {-b, a - b}, {b - a, -a}, {2.0 * (a - b), 2.0 * a}}};
    point.du = derivatives[corner][0];
    point.dv = derivatives[corner][1];
    constexpr glm::dvec2 kA(1.0, 0.0), kB(0.0, 1.0);
    constexpr std::array<std::array<glm::dvec2, 2>, 4> kSlopes = {
        {{kA, kB}, {-kB, kA - kB}, {kB - kA, -kA}, {2.0 * (kA - kB), 2.0 * kA}}};
    catmull_clark::turnSecondDerivatives(kSlopes[corner][0], kSlopes[corner][1], point);
    if (point.du != glm::dvec3(0.0)) {
        point.normal = subdivision::unitOrZero(glm::cross(point.du, point.dv));
    }
    return point;
}

Point LimitSurface::atDistance(const LevelNet& net, uint32_t sector, double a, double b) {
    const Fragment& fragment = net.fragment();
    const Fan fan{Subdivision::loop, fragment.sectors, fragment.open};
    const Lattice lattice(net, fan, sector);
    const double scale = std::exp2(net.level()), x = a * scale, y = b * scale;
    Point point;
    if (x >= 1.0) {
        point = boxSpline(lattice, {1, 0}, 1, x - 1.0, y);
    } else if (y >= 1.0) {
        point = boxSpline(lattice, {0, 1}, 1, x, y - 1.0);
    } else if (x + y < 1.0) { // of a uniform vertex alone: elsewhere a finer level has the place
        point = boxSpline(lattice, {0, 0}, 1, x, y);
    } else {
        point = boxSpline(lattice, {1, 1}, -1, 1.0 - x, 1.0 - y);
        point.du = -point.du, point.dv = -point.dv;
    }
    addSpokes(lattice, x, y, point);
    point.position += net.origin();
    point.du *= scale, point.dv *= scale;
    catmull_clark::turnSecondDerivatives({scale, 0.0}, {0.0, scale}, point);
    return point;
}

Point LimitSurface::inMiddle(const LevelNet& net, double x, double y) {
    const Lattice lattice(net);
    Point point = boxSpline(lattice, {0, 0}, 1, x, y);
    point.position += net.origin();
    const std::array<double, 3> weights = {1.0 - x - y, x, y};
    const std::array<glm::dvec2, 3> slopes = {{{-1.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}}};
    for (size_t corner = 0; corner < 3; ++corner) {
        Excess excess{};
        for (size_t k = 0; k < 2; ++k) {
            const Mirror& m = kMirrors[2 * corner + k];
            excess[1 + k] = lattice.excess(m.end, m.otherEnd, m.own, m.mirrored);
        }
        const size_t last = (corner + 2) % 3;
        const Point crease =
            creaseExcess(excess, lattice.semiSharp(corner), 1.0 - weights[last], 1.0 - weights[corner]);
        addCrease(crease, -slopes[last], -slopes[corner], point);
    }
    return point;
}

} // namespace supple::surface::loop
