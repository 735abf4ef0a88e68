#include "uv.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace supple::creature {

namespace {

// Which side of its part's seam a quad is on: tubes are cut into two halves.
int side(const Cage& cage, const Quad& quad) {
    Vec3 centre{0};
    for (int point : quad.points) {
        centre += cage.position(point) * 0.25;
    }
    const Vec3 normal = glm::cross(cage.position(quad.points[2]) - cage.position(quad.points[0]),
                                   cage.position(quad.points[3]) - cage.position(quad.points[1]));
    switch (quad.part) {
    case Part::Torso:
    case Part::Head:
        return centre.z > 0 ? 1 : 0;
    case Part::Tail:
    case Part::TailFin:
    case Part::Spike:
        return centre.x > 0 ? 1 : 0;
    case Part::Mouth:
    case Part::Lid:
        return 0;
    default:
        return normal.z > 0 ? 1 : 0;
    }
}

struct Flat {
    std::map<int, Vec2> at; // by point
    Vec2 size{0};
};

Flat flatten(const Cage& cage, const std::vector<size_t>& quads) {
    Vec3 normal{0};
    for (size_t q : quads) {
        const auto& p = cage.quads[q].points;
        normal += glm::cross(cage.position(p[2]) - cage.position(p[0]), cage.position(p[3]) - cage.position(p[1]));
    }
    if (glm::length(normal) < 1e-9) {
        normal = {0, 0, 1};
    }
    const Vec3 hint = std::abs(glm::normalize(normal).y) > 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Frame frame = frameFrom({0, 0, 0}, normal, glm::cross(hint, normal));

    // Springs along edges and diagonals pull the shadow of the chart out to its true lengths.
    struct Spring {
        int a, b;
        double length;
    };
    std::vector<Spring> springs;
    Flat flat;
    for (size_t q : quads) {
        const auto& p = cage.quads[q].points;
        for (size_t i = 0; i < 4; ++i) {
            const Vec3& at = cage.position(p[i]);
            flat.at[p[i]] = {glm::dot(at, frame.across), glm::dot(at, frame.along)};
            springs.push_back({p[i], p[(i + 1) % 4], glm::length(cage.position(p[(i + 1) % 4]) - at)});
        }
        springs.push_back({p[0], p[2], glm::length(cage.position(p[2]) - cage.position(p[0]))});
        springs.push_back({p[1], p[3], glm::length(cage.position(p[3]) - cage.position(p[1]))});
    }
    for (int round = 0; round < 400; ++round) {
        for (const Spring& spring : springs) {
            Vec2& a = flat.at[spring.a];
            Vec2& b = flat.at[spring.b];
            const Vec2 d = b - a;
            const double length = std::max(glm::length(d), 1e-6);
            const Vec2 move = d * (0.2 * (length - spring.length) / length);
            a += move;
            b -= move;
        }
    }
    Vec2 low{1e30};
    Vec2 high{-1e30};
    for (const auto& [point, at] : flat.at) {
        low = {std::min(low.x, at.x), std::min(low.y, at.y)};
        high = {std::max(high.x, at.x), std::max(high.y, at.y)};
    }
    for (auto& [point, at] : flat.at) {
        at -= low;
    }
    flat.size = high - low;
    return flat;
}

} // namespace

Atlas unwrap(const Cage& cage) {
    Atlas atlas;
    atlas.chart.assign(cage.quads.size(), -1);
    atlas.corners.resize(cage.quads.size());

    // Charts are the connected runs of quads of one part, shell and side.
    std::map<std::pair<int, int>, size_t> owner;
    for (size_t q = 0; q < cage.quads.size(); ++q) {
        for (size_t i = 0; i < 4; ++i) {
            owner[{cage.quads[q].points[i], cage.quads[q].points[(i + 1) % 4]}] = q;
        }
    }
    std::vector<Flat> flats;
    std::vector<std::vector<size_t>> members;
    for (size_t first = 0; first < cage.quads.size(); ++first) {
        if (atlas.chart[first] >= 0) {
            continue;
        }
        const int chart = static_cast<int>(members.size());
        std::vector<size_t> found{first};
        atlas.chart[first] = chart;
        for (size_t k = 0; k < found.size(); ++k) {
            const Quad& quad = cage.quads[found[k]];
            for (size_t i = 0; i < 4; ++i) {
                const size_t next = owner.at({quad.points[(i + 1) % 4], quad.points[i]});
                if (atlas.chart[next] < 0 && cage.quads[next].part == quad.part &&
                    side(cage, cage.quads[next]) == side(cage, quad)) {
                    atlas.chart[next] = chart;
                    found.push_back(next);
                }
            }
        }
        members.push_back(found);
        flats.push_back(flatten(cage, found));
    }

    // Shelves, tallest chart first.
    const double margin = 0.012;
    std::vector<std::pair<long, size_t>> order;
    double area = 0;
    for (size_t c = 0; c < flats.size(); ++c) {
        order.push_back({-std::lround(flats[c].size.y * 1e5), c});
        area += (flats[c].size.x + margin) * (flats[c].size.y + margin);
    }
    std::sort(order.begin(), order.end());
    const double width = std::sqrt(area) * 1.06;
    std::vector<Vec2> corner(flats.size());
    Vec2 pen{margin};
    double shelf = 0;
    double used = width;
    for (const auto& [height, c] : order) {
        if (pen.x + flats[c].size.x + margin > width) {
            pen = {margin, pen.y + shelf + margin};
            shelf = 0;
        }
        corner[c] = pen;
        pen.x += flats[c].size.x + margin;
        shelf = std::max(shelf, flats[c].size.y);
        used = std::max({used, pen.x, pen.y + shelf + margin});
    }
    for (size_t q = 0; q < cage.quads.size(); ++q) {
        const size_t c = static_cast<size_t>(atlas.chart[q]);
        for (size_t i = 0; i < 4; ++i) {
            const Vec2 at = (corner[c] + flats[c].at.at(cage.quads[q].points[i])) / used;
            atlas.corners[q][i] = {at.x, 1 - at.y};
        }
    }
    return atlas;
}

} // namespace supple::creature
