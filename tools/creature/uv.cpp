#include "uv.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace supple::creature {

namespace {

// Which side of its part's seam a quad is on: tubes are cut into two halves.
int side(const Cage& cage, const Face& face) {
    const Vec3 centre = cage.centre(face);
    const Vec3 normal = cage.normal(face);
    switch (face.part) {
    case Part::Torso:
    case Part::Head:
        return centre.z > 0 ? 1 : 0;
    case Part::Tail:
    case Part::TailFin:
    case Part::Spike:
        return centre.x > 0 ? 1 : 0;
    case Part::Mouth:
    case Part::Lid:
    case Part::Belly:
    case Part::Web:
        return 0;
    default:
        return normal.z > 0 ? 1 : 0;
    }
}

struct Flat {
    std::map<int, Vec2> at; // by point
    Vec2 size{0};
};

struct Spring {
    int a, b;
    double length;
};

// The longest loop of edges that only one of the faces has, in their winding.
std::vector<int> rim(const Cage& cage, const std::vector<size_t>& faces) {
    std::map<std::pair<int, int>, bool> edges;
    for (size_t q : faces) {
        const auto& p = cage.faces[q].points;
        for (size_t i = 0; i < p.size(); ++i) {
            edges[{p[i], p[(i + 1) % p.size()]}] = true;
        }
    }
    std::map<int, int> next;
    for (const auto& [edge, used] : edges) {
        if (!edges.count({edge.second, edge.first})) {
            next[edge.first] = edge.second;
        }
    }
    std::vector<int> longest;
    while (!next.empty()) {
        std::vector<int> loop{next.begin()->first};
        for (auto it = next.begin(); it != next.end(); it = next.find(loop.back())) {
            loop.push_back(it->second);
            next.erase(it);
        }
        loop.pop_back();
        if (loop.size() > longest.size()) {
            longest = loop;
        }
    }
    return longest;
}

size_t folds(const Cage& cage, const std::vector<size_t>& faces, const std::map<int, Vec2>& at) {
    size_t count = 0;
    for (size_t q : faces) {
        const auto& p = cage.faces[q].points;
        for (size_t i = 0; i < p.size(); ++i) {
            const Vec2 u = at.at(p[(i + 1) % p.size()]) - at.at(p[i]);
            const Vec2 v = at.at(p[(i + p.size() - 1) % p.size()]) - at.at(p[i]);
            count += u.x * v.y - u.y * v.x <= 0;
        }
    }
    return count;
}

Flat flatten(const Cage& cage, const std::vector<size_t>& faces) {
    std::vector<Spring> springs;
    std::map<int, std::vector<int>> around;
    double area = 0;
    for (size_t q : faces) {
        const auto& p = cage.faces[q].points;
        for (size_t i = 0; i < p.size(); ++i) {
            const int next = p[(i + 1) % p.size()];
            springs.push_back({p[i], next, glm::length(cage.position(next) - cage.position(p[i]))});
            around[p[i]].push_back(next);
            around[next].push_back(p[i]);
        }
        for (size_t i = 0; i < p.size(); ++i) {
            for (size_t k = i + 2; k < p.size() - (i == 0); ++k) {
                springs.push_back({p[i], p[k], glm::length(cage.position(p[k]) - cage.position(p[i]))});
            }
        }
        area += 0.5 * glm::length(cage.normal(cage.faces[q]));
    }

    // First stretched in a round hoop, which cannot fold.
    Flat flat;
    const std::vector<int> hoop = rim(cage, faces);
    double round = 0;
    for (size_t i = 0; i < hoop.size(); ++i) {
        round += glm::length(cage.position(hoop[(i + 1) % hoop.size()]) - cage.position(hoop[i]));
    }
    for (const auto& [point, list] : around) {
        flat.at[point] = {0, 0};
    }
    double travelled = 0;
    const double radius = std::sqrt(area / kPi);
    for (size_t i = 0; i < hoop.size(); ++i) {
        const double angle = 2 * kPi * travelled / round;
        flat.at[hoop[i]] = Vec2{std::cos(angle), std::sin(angle)} * radius;
        travelled += glm::length(cage.position(hoop[(i + 1) % hoop.size()]) - cage.position(hoop[i]));
    }
    for (int pass = 0; pass < 300; ++pass) {
        for (auto& [point, at] : flat.at) {
            if (std::find(hoop.begin(), hoop.end(), point) == hoop.end()) {
                const std::vector<int>& list = around.at(point);
                at = {0, 0};
                for (int other : list) {
                    at += flat.at.at(other) / static_cast<double>(list.size());
                }
            }
        }
    }

    // Then springs along edges and diagonals pull it to its true lengths, as far as that folds nothing.
    size_t leastFolds = folds(cage, faces, flat.at);
    std::map<int, Vec2> best = flat.at;
    for (int pass = 1; pass <= 400; ++pass) {
        for (const Spring& spring : springs) {
            Vec2& a = flat.at[spring.a];
            Vec2& b = flat.at[spring.b];
            const Vec2 d = b - a;
            const double length = std::max(glm::length(d), 1e-6);
            const Vec2 move = d * (0.1 * (length - spring.length) / length);
            a += move;
            b -= move;
        }
        if (pass % 10 == 0) {
            const size_t now = folds(cage, faces, flat.at);
            if (now <= leastFolds) {
                leastFolds = now;
                best = flat.at;
            }
        }
    }
    flat.at = best;

    // Upright for the eye: turned so that up in the model is up in the picture, as well as it can be.
    Vec2 up{0};
    for (const Spring& spring : springs) {
        up += (flat.at[spring.b] - flat.at[spring.a]) * (cage.position(spring.b).y - cage.position(spring.a).y);
    }
    const double length = glm::length(up);
    if (length > 1e-9) {
        up /= length;
        for (auto& [point, at] : flat.at) {
            at = {at.x * up.y - at.y * up.x, at.x * up.x + at.y * up.y};
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
    atlas.chart.assign(cage.faces.size(), -1);
    atlas.corners.resize(cage.faces.size());

    // Charts are the connected runs of faces of one part, shell and side.
    const std::map<std::pair<int, int>, size_t> owner = cage.directedEdges();
    std::vector<Flat> flats;
    std::vector<std::vector<size_t>> members;
    for (size_t first = 0; first < cage.faces.size(); ++first) {
        if (atlas.chart[first] >= 0) {
            continue;
        }
        const int chart = static_cast<int>(members.size());
        std::vector<size_t> found{first};
        atlas.chart[first] = chart;
        for (size_t k = 0; k < found.size(); ++k) {
            const Face& face = cage.faces[found[k]];
            for (size_t i = 0; i < face.points.size(); ++i) {
                const auto across = owner.find({face.points[(i + 1) % face.points.size()], face.points[i]});
                if (across == owner.end()) {
                    continue;
                }
                const size_t next = across->second;
                if (atlas.chart[next] < 0 && cage.faces[next].part == face.part &&
                    side(cage, cage.faces[next]) == side(cage, face)) {
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
    for (size_t q = 0; q < cage.faces.size(); ++q) {
        const size_t c = static_cast<size_t>(atlas.chart[q]);
        for (int point : cage.faces[q].points) {
            const Vec2 at = (corner[c] + flats[c].at.at(point)) / used;
            atlas.corners[q].push_back({at.x, 1 - at.y});
        }
    }
    return atlas;
}

} // namespace supple::creature
