#include "tools/reference/loop.h"

#include "tools/reference/fragment.h"
#include "tools/reference/fragments.h"

#include <array>
#include <cmath>

namespace supple::surface::loop {
namespace {

using subdivision::Fan;
using subdivision::Fragment;
using subdivision::FragmentNet;

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

/// The points of a fragment by their places. What lies across an endless crease is the mirror image of what lies on
/// this side: the point that makes a parallelogram with the triangle at the crease.
class Lattice {
public:
    Lattice(const FragmentNet<double>& net, const Fan& fan, uint32_t sector)
        : points_(net.points()), fan_(fan), sector_(sector),
          facet_(false), sharp_{net.sharpnessOf(sector) > 0.0f,
                                net.sharpnessOf((sector + 1) % (fan.sectors + (fan.open ? 1 : 0))) > 0.0f, false} {}
    explicit Lattice(const FragmentNet<double>& net)
        : points_(net.points()),
          facet_(true), sharp_{net.sharpnessOf(0) > 0.0f, net.sharpnessOf(1) > 0.0f, net.sharpnessOf(2) > 0.0f} {}

    [[nodiscard]] glm::dvec3 at(const Place& p) const {
        if (!facet_) {
            return inSector(p);
        }
        // Each line through a corner has two points on its far side; with them, the triangles they mirror.
        struct Mirror {
            uint32_t line;
            Place own, end, otherEnd, mirrored;
        };
        constexpr Mirror kMirrors[] = {{0, {-1, 0}, {0, 0}, {-1, 1}, {0, 1}}, {0, {0, -1}, {0, 0}, {1, -1}, {1, 0}},
                                       {1, {2, -1}, {1, 0}, {1, -1}, {0, 0}}, {1, {2, 0}, {1, 0}, {1, 1}, {0, 1}},
                                       {2, {0, 2}, {0, 1}, {1, 1}, {1, 0}},   {2, {-1, 2}, {0, 1}, {-1, 1}, {0, 0}}};
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

    const std::vector<glm::dvec3>& points_;
    Fan fan_;
    uint32_t sector_ = 0;
    bool facet_;
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
    for (int m = 0; m <= 4; ++m) {
        for (int n = 0; m + n <= 4; ++n) {
            const glm::dvec3& own = c[static_cast<size_t>(m)][static_cast<size_t>(n)];
            point.position += own * std::pow(x, m) * std::pow(y, n);
            point.du += m == 0 ? glm::dvec3(0.0) : own * (m * std::pow(x, m - 1) * std::pow(y, n));
            point.dv += n == 0 ? glm::dvec3(0.0) : own * (n * std::pow(x, m) * std::pow(y, n - 1));
        }
    }
    return point;
}

} // namespace

LimitSurface::LimitSurface(const subdivision::Mesh& mesh, std::span<const glm::dvec3> positions)
    : mesh_(mesh), isolated_(subdivision::isolate<double>(mesh, positions)), sectors_(mesh.cage.faceCount()) {
    const FragmentNet<double> net(mesh, isolated_);
    for (uint32_t f = 0; f < mesh.fragments.size(); ++f) {
        const Fragment& fragment = mesh.fragments[f];
        const Fan fan = net.fanOf(fragment);
        if (fragment.kind == subdivision::FragmentKind::vertex && !patterns_.contains(fan)) {
            patterns_.emplace(fan, fanPattern(fan, 1));
        }
        for (uint32_t h = 0; h < fragment.sectors; ++h) {
            sectors_[mesh.sectorFaces[fragment.firstSector + h]] = {f, h};
        }
    }
}

Point LimitSurface::at(uint32_t triangle, double v, double w) const {
    const std::array<double, 3> weights = {1.0 - v - w, v, w};
    uint32_t corner = 0;
    while (corner < 3 && weights[corner] <= 0.5) {
        ++corner;
    }
    const Sector& sector = sectors_[4 * size_t{triangle} + corner];
    Point point = corner == 3 ? inMiddle(sector, 1.0 - 2.0 * weights[0], 1.0 - 2.0 * weights[1])
                              : atDistance(sector, weights[(corner + 1) % 3], weights[(corner + 2) % 3]);
    const glm::dvec3 a = point.du, b = point.dv;
    const std::array<std::array<glm::dvec3, 2>, 4> derivatives = {
        {{a, b}, {-b, a - b}, {b - a, -a}, {2.0 * (a - b), 2.0 * a}}};
    point.du = derivatives[corner][0];
    point.dv = derivatives[corner][1];
    if (point.du != glm::dvec3(0.0)) {
        point.normal = subdivision::unitOrZero(glm::cross(point.du, point.dv));
    }
    return point;
}

Point LimitSurface::atDistance(const Sector& sector, double a, double b) const {
    const Fragment& fragment = mesh_.fragments[sector.fragment];
    FragmentNet<double> net(mesh_, isolated_);
    net.load(fragment);
    const Fan fan = net.fanOf(fragment);
    if (a + b < std::exp2(-kMostLevels)) {
        return catmull_clark::limitAtCentre(mesh_, isolated_, sector.fragment, sector.number);
    }
    int exponent = 0;
    std::frexp(a + b, &exponent);
    const int level = std::max(1 - exponent, 2); // 2^-level <= a + b < 2^(1 - level)
    for (int j = 2; j <= level; ++j) {
        net.refine(fan, patterns_.at(fan), pointCount(fan, 3));
    }
    const Lattice lattice(net, fan, sector.number);
    const double scale = std::exp2(level), x = a * scale, y = b * scale;
    Point point;
    if (x >= 1.0) {
        point = boxSpline(lattice, {1, 0}, 1, x - 1.0, y);
    } else if (y >= 1.0) {
        point = boxSpline(lattice, {0, 1}, 1, x, y - 1.0);
    } else {
        point = boxSpline(lattice, {1, 1}, -1, 1.0 - x, 1.0 - y);
        point.du = -point.du, point.dv = -point.dv;
    }
    point.du *= scale, point.dv *= scale;
    return point;
}

Point LimitSurface::inMiddle(const Sector& facet, double x, double y) const {
    FragmentNet<double> net(mesh_, isolated_);
    net.load(mesh_.fragments[facet.fragment]);
    return boxSpline(Lattice(net), {0, 0}, 1, x, y);
}

} // namespace supple::surface::loop
