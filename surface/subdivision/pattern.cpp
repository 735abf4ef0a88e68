#include "surface/subdivision/pattern.h"

#include <algorithm>
#include <cassert>

namespace supple::surface::subdivision {
namespace {

/// A point of a sector or a facet, or the way from one to another.
struct Point {
    int32_t a = 0, b = 0;
};

constexpr Point operator+(Point p, Point q) {
    return {p.a + q.a, p.b + q.b};
}
constexpr Point operator-(Point p) {
    return {-p.a, -p.b};
}

/// Points of a ring that belong to one sector, over the ring's radius.
constexpr uint32_t pointsPerSector(Subdivision subdivision) {
    return subdivision == Subdivision::catmullClark ? 2 : 1;
}

/// A quarter turn, or a sixth: to the next direction in which an edge runs.
constexpr Point turned(Subdivision subdivision, Point way) {
    return subdivision == Subdivision::catmullClark ? Point{-way.b, way.a} : Point{-way.b, way.a + way.b};
}

constexpr Point kAlong{1, 0}, kUp{0, 1}, kRound{-1, 1};

/// Half a coordinate, down.
constexpr int32_t halved(int32_t x) {
    return x >= 0 ? x / 2 : (x - 1) / 2;
}
constexpr bool odd(int32_t x) {
    return x % 2 != 0;
}

/// All neighbours' ways, counter-clockwise from `axis` on.
std::array<Point, 8> waysRound(Subdivision subdivision, Point axis) {
    std::array<Point, 8> ways{};
    if (subdivision == Subdivision::loop) {
        for (uint32_t k = 0; k < 6; ++k) {
            ways[k] = axis;
            axis = turned(subdivision, axis);
        }
        return ways;
    }
    for (uint32_t k = 0; k < 8; k += 2) {
        const Point next = turned(subdivision, axis);
        ways[k] = axis;
        ways[k + 1] = axis + next;
        axis = next;
    }
    return ways;
}

/// Fills a row but for its spoke. `axisAt` gives the axis of a coarse point, `indexOf` the index of one; its first
/// source stands in for what `indexOf` does not know.
template <class AxisAt, class IndexOf>
Row makeRow(Subdivision subdivision, Point fine, AxisAt&& axisAt, IndexOf&& indexOf) {
    const Point p{halved(fine.a), halved(fine.b)};
    Row row;
    uint32_t count = 0;
    const auto add = [&](Point source) {
        const uint32_t index = indexOf(source);
        row.sources[count++] = index == kNoPoint ? row.sources[0] : index;
    };
    if (!odd(fine.a) && !odd(fine.b)) {
        row.rule = Rule::vertex;
        add(p);
        if (subdivision == Subdivision::loop) {
            const std::array<Point, 8> ways = waysRound(subdivision, axisAt(p));
            for (const uint32_t k : {0u, 3u, 1u, 2u, 4u, 5u}) {
                add(p + ways[k]);
            }
        }
    } else if (subdivision == Subdivision::loop) {
        row.rule = Rule::edge;
        const bool diagonal = odd(fine.a) && odd(fine.b);
        const Point begin = diagonal ? p + kAlong : p;
        const Point edge = diagonal ? kRound : odd(fine.a) ? kAlong : kUp;
        const Point left = turned(subdivision, edge);
        add(begin);
        add(begin + edge);
        add(begin + left);
        add(begin + edge + -left);
    } else if (odd(fine.a) && odd(fine.b)) {
        row.rule = Rule::face;
        add(p);
        add(p + kAlong + kUp);
        add(p + kAlong);
        add(p + kUp);
    } else {
        row.rule = Rule::edge;
        const Point edge = odd(fine.a) ? kAlong : kUp;
        const Point left = turned(subdivision, edge);
        add(p);
        add(p + edge);
        for (const Point side : {left, -left}) {
            add(p + side);
            add(p + edge + side);
        }
    }
    return row;
}

/// What stands at the points of a fan, ring by ring.
class FanBuilder {
public:
    explicit FanBuilder(const Fan& fan) : fan_(fan) {}

    Pattern run(uint32_t steps) {
        const uint32_t covered = 1u << steps;
        pattern_.neighbours.reserve(pointCount(fan_, covered));
        pattern_.spokes.reserve(pointCount(fan_, covered));
        addCentre(steps > 0);
        for (uint32_t ring = 1; ring <= covered + 1; ++ring) {
            for (uint32_t sector = 0; sector < fan_.sectors; ++sector) {
                for (uint32_t t = 0; t < pointsPerSector(fan_.subdivision) * ring; ++t) {
                    add(sector, pointOf(ring, t), steps > 0, ring <= covered);
                }
            }
            if (fan_.open) {
                add(fan_.sectors - 1, {0, static_cast<int32_t>(ring)}, steps > 0, ring <= covered);
            }
        }
        return std::move(pattern_);
    }

private:
    [[nodiscard]] Point pointOf(uint32_t ring, uint32_t t) const {
        const auto r = static_cast<int32_t>(ring);
        const auto k = static_cast<int32_t>(t);
        if (fan_.subdivision == Subdivision::loop) {
            return {r - k, k};
        }
        return k <= r ? Point{r, k} : Point{2 * r - k, r};
    }

    void addCentre(bool rows) {
        if (rows) {
            Row row;
            row.rule = Rule::centre;
            pattern_.rows.push_back(row);
        }
        pattern_.neighbours.emplace_back();
        pattern_.spokes.push_back(kNoSpoke);
    }

    void add(uint32_t sector, Point at, bool rows, bool covered) {
        const auto indexOf = [&](Point p) { return pointIndex(fan_, sector, p.a, p.b); };
        if (rows) {
            Row row = makeRow(
                fan_.subdivision, at, [&](Point p) { return axisAt(p); }, indexOf);
            row.spoke = spokeOf(sector, at);
            pattern_.rows.push_back(row);
        }
        if (covered) {
            const uint32_t own = indexOf(at);
            assert(own == pattern_.neighbours.size());
            const std::array<Point, 8> ways = waysRound(fan_.subdivision, axisAt(at));
            Neighbours& neighbours = pattern_.neighbours.emplace_back();
            for (uint32_t k = 0; k < (fan_.subdivision == Subdivision::loop ? 6 : 8); ++k) {
                const uint32_t index = indexOf(at + ways[k]);
                neighbours[k] = index == kNoPoint ? own : index;
            }
            pattern_.spokes.push_back(spokeOf(sector, at));
        }
    }

    /// Of a fan's points only an open one's last spoke has a = 0.
    [[nodiscard]] static uint32_t spokeOf(uint32_t sector, Point at) {
        return at.b == 0 ? sector : at.a == 0 ? sector + 1 : kNoSpoke;
    }

    /// The line that all fragments which have this point agree on: the spoke, else Loop's ring. Catmull-Clark's rules
    /// read the same along every edge.
    [[nodiscard]] Point axisAt(Point p) const {
        if (p.b == 0) {
            return kAlong;
        }
        if (p.a == 0) {
            return kUp;
        }
        return fan_.subdivision == Subdivision::loop ? kRound : kAlong;
    }

    Fan fan_;
    Pattern pattern_;
};

/// The facet's side that a point's crease runs along, were there one: of the corners and, on the line of the edge that
/// was split there, their neighbours in the halo.
uint32_t facetLine(int32_t side, Point at) {
    if ((at.a == 0 && at.b == 0) || (at.a == -1 && at.b == 1) || (at.a == 1 && at.b == -1)) {
        return 0;
    }
    if (at.a == side && at.b >= -1 && at.b <= 1) {
        return 1;
    }
    return at.b == side && at.a >= -1 && at.a <= 1 ? 2 : kNoSpoke;
}

/// At the corners the edge of the cage that was split there, else the side, else any.
Point facetAxis(int32_t side, Point at) {
    if (at.a == 0 && at.b == 0) {
        return kRound;
    }
    if (at.a == side) {
        return kUp;
    }
    if (at.b == side || at.b == 0) {
        return kAlong;
    }
    return at.a == 0 ? kUp : kRound;
}

} // namespace

uint32_t pointCount(const Fan& fan, uint32_t radius) {
    return 1 + pointsPerSector(fan.subdivision) * fan.sectors * (radius * (radius + 1) / 2) + (fan.open ? radius : 0);
}

uint32_t pointIndex(const Fan& fan, uint32_t sector, int32_t a, int32_t b) {
    const bool loop = fan.subdivision == Subdivision::loop;
    while (a < 0 || b < 0) {
        const bool back = b < 0;
        const Point p = back ? (loop ? Point{-b, a + b} : Point{-b, a}) : (loop ? Point{a + b, -a} : Point{b, -a});
        const uint32_t last = fan.sectors - 1;
        if (fan.open && sector == (back ? 0 : last)) {
            return kNoPoint;
        }
        sector = back ? (sector == 0 ? last : sector - 1) : (sector == last ? 0 : sector + 1);
        a = p.a;
        b = p.b;
    }
    const auto ring = static_cast<uint32_t>(loop ? a + b : std::max(a, b));
    if (ring == 0) {
        return 0;
    }
    const uint32_t perSector = pointsPerSector(fan.subdivision) * ring;
    const auto t = static_cast<uint32_t>(loop || a >= b ? b : 2 * b - a);
    const uint32_t place = perSector * sector + t;
    const bool again = !fan.open && place == perSector * fan.sectors; // spoke m is spoke 0
    return pointCount(fan, ring - 1) + (again ? 0 : place);
}

uint32_t facetPointCount(uint32_t side) {
    return (side * side + 9 * side + 14) / 2;
}

uint32_t facetPointIndex(uint32_t side, int32_t a, int32_t b) {
    const auto n = static_cast<int32_t>(side);
    const int32_t row = a + b;
    if (row < -1 || row > n + 1 || a < -1 || b < -1 || a > n + 1 || b > n + 1) {
        return kNoPoint;
    }
    const int32_t place = b == -1 ? row + 1 : a == -1 ? row + 2 : b;
    return static_cast<uint32_t>((row + 2) * (row + 3) / 2 - 1 + place);
}

Pattern fanPattern(const Fan& fan, uint32_t steps) {
    return FanBuilder(fan).run(steps);
}

Pattern facetPattern(uint32_t step) {
    const uint32_t side = 1u << step;
    const auto n = static_cast<int32_t>(side);
    Pattern pattern;
    pattern.rows.resize(step > 0 ? facetPointCount(side) : 0);
    pattern.neighbours.resize(facetPointCount(side));
    pattern.spokes.assign(facetPointCount(side), kNoSpoke);
    for (int32_t a = -1; a <= n + 1; ++a) {
        for (int32_t b = -1; b <= n + 1; ++b) {
            const Point at{a, b};
            const uint32_t index = facetPointIndex(side, a, b);
            if (index == kNoPoint) {
                continue;
            }
            if (step > 0) {
                Row& row = pattern.rows[index];
                row = makeRow(
                    Subdivision::loop, at, [&](Point p) { return facetAxis(n / 2, p); },
                    [&](Point p) { return facetPointIndex(side / 2, p.a, p.b); });
                row.spoke = facetLine(n, at);
            }
            pattern.neighbours[index].fill(index);
            if (a < 0 || b < 0 || a + b > n) {
                continue;
            }
            pattern.spokes[index] = facetLine(n, at);
            const std::array<Point, 8> ways = waysRound(Subdivision::loop, facetAxis(n, at));
            for (uint32_t k = 0; k < 6; ++k) {
                pattern.neighbours[index][k] = facetPointIndex(side, a + ways[k].a, b + ways[k].b);
            }
        }
    }
    return pattern;
}

} // namespace supple::surface::subdivision
