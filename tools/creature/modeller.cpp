#include "modeller.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>

namespace supple::creature {

namespace {

[[noreturn]] void fail(const char* message) {
    std::fprintf(stderr, "supple_creature: %s\n", message);
    std::exit(1);
}

bool onMirrorPlane(const Point& point) {
    return point.position.x == 0.0;
}

} // namespace

Frame frameFrom(const Vec3& origin, const Vec3& out, const Vec3& hint) {
    Frame frame;
    frame.origin = origin;
    frame.out = glm::normalize(out);
    frame.across = glm::normalize(hint - frame.out * glm::dot(hint, frame.out));
    frame.along = glm::cross(frame.out, frame.across);
    return frame;
}

int Cage::addPoint(const Vec3& position) {
    Point point;
    point.position = position;
    point.part = part;
    point.shell = shell;
    points.push_back(point);
    return static_cast<int>(points.size()) - 1;
}

void Cage::addQuad(int a, int b, int c, int d) {
    quads.push_back({{a, b, c, d}, part});
}

Patch Cage::seed(int columns, int rows, bool half, Patch& underside) {
    Patch top{columns, rows, half, {}};
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            // Off the mirror plane only matters for telling wall from plane; placing comes later.
            top.points.push_back(addPoint({half && column == 0 ? 0.0 : 1.0 + column, 0.0, row}));
        }
    }
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            addQuad(top.at(column, row), top.at(column + 1, row), top.at(column + 1, row + 1), top.at(column, row + 1));
        }
    }
    underside = top;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            addQuad(top.at(column, row), top.at(column, row + 1), top.at(column + 1, row + 1), top.at(column + 1, row));
        }
    }
    // The first set faces across x along and is the one to lift: give it points of its own with an edge-less extrude.
    std::vector<int> fresh(top.points.size());
    for (size_t i = 0; i < top.points.size(); ++i) {
        fresh[i] = addPoint(position(top.points[i]));
    }
    const size_t firstTop = quads.size() - 2 * static_cast<size_t>(columns * rows);
    std::map<int, int> renamed;
    for (size_t i = 0; i < fresh.size(); ++i) {
        renamed[top.points[i]] = fresh[i];
    }
    std::set<std::pair<int, int>> directed;
    for (size_t q = firstTop; q < firstTop + static_cast<size_t>(columns * rows); ++q) {
        for (int i = 0; i < 4; ++i) {
            directed.insert({quads[q].points[i], quads[q].points[(i + 1) % 4]});
        }
        for (int& point : quads[q].points) {
            point = renamed[point];
        }
    }
    for (const auto& [a, b] : directed) {
        const bool inPlane =
            half && onMirrorPlane(points[static_cast<size_t>(a)]) && onMirrorPlane(points[static_cast<size_t>(b)]);
        if (!directed.count({b, a}) && !inPlane) {
            addQuad(a, b, renamed[b], renamed[a]);
        }
    }
    top.points = fresh;
    return top;
}

int Cage::findQuad(const std::array<int, 4>& corners) const {
    std::array<int, 4> wanted = corners;
    std::sort(wanted.begin(), wanted.end());
    for (size_t q = 0; q < quads.size(); ++q) {
        std::array<int, 4> have = quads[q].points;
        std::sort(have.begin(), have.end());
        if (have == wanted) {
            return static_cast<int>(q);
        }
    }
    fail("a patch names a quad the cage has not got");
}

Patch Cage::patch(int columns, int rows, bool half, const std::vector<int>& grid) const {
    Patch made{columns, rows, half, grid};
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            findQuad({made.at(column, row), made.at(column + 1, row), made.at(column + 1, row + 1),
                      made.at(column, row + 1)});
        }
    }
    return made;
}

Patch Cage::cell(const Patch& from, int column, int row) const {
    return patch(
        1, 1, false,
        {from.at(column, row), from.at(column + 1, row), from.at(column, row + 1), from.at(column + 1, row + 1)});
}

Patch Cage::extrude(const Patch& from) {
    Patch lifted{from.columns, from.rows, from.half, {}};
    std::map<int, int> renamed;
    for (int point : from.points) {
        const Point old = points[static_cast<size_t>(point)];
        const int fresh = addPoint(old.position);
        renamed[point] = fresh;
        lifted.points.push_back(fresh);
    }
    std::vector<std::pair<int, int>> edges;
    std::set<std::pair<int, int>> directed;
    for (int row = 0; row < from.rows; ++row) {
        for (int column = 0; column < from.columns; ++column) {
            const int q = findQuad({from.at(column, row), from.at(column + 1, row), from.at(column + 1, row + 1),
                                    from.at(column, row + 1)});
            Quad& quad = quads[static_cast<size_t>(q)];
            for (int i = 0; i < 4; ++i) {
                edges.push_back({quad.points[i], quad.points[(i + 1) % 4]});
                directed.insert(edges.back());
            }
            for (int& point : quad.points) {
                point = renamed[point];
            }
            quad.part = part;
        }
    }
    for (const auto& [a, b] : edges) {
        const bool inPlane =
            from.half && onMirrorPlane(points[static_cast<size_t>(a)]) && onMirrorPlane(points[static_cast<size_t>(b)]);
        if (!directed.count({b, a}) && !inPlane) {
            addQuad(a, b, renamed[b], renamed[a]);
        }
    }
    return lifted;
}

void Cage::placeDisk(const Patch& patch, const Frame& frame, double radiusAcross, double radiusAlong, double dome) {
    const int columns = patch.half ? patch.columns * 2 : patch.columns;
    const int rows = patch.rows;
    const double step = 2 * kPi / (2 * (columns + rows));
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= patch.columns; ++column) {
            const double s = patch.half ? static_cast<double>(column) / patch.columns : 2.0 * column / columns - 1.0;
            const double t = 2.0 * row / rows - 1.0;
            double x = s * std::sqrt(1.0 - t * t / 2);
            double y = t * std::sqrt(1.0 - s * s / 2);
            const double fromMiddleColumn = s * columns / 2;
            const double fromMiddleRow = t * rows / 2;
            if (row == 0 || row == rows) {
                x = std::sin(fromMiddleColumn * step);
                y = std::cos(fromMiddleColumn * step) * (row == 0 ? -1 : 1);
            } else if (column == patch.columns || (column == 0 && !patch.half)) {
                y = std::sin(fromMiddleRow * step);
                x = std::cos(fromMiddleRow * step) * (column == 0 ? -1 : 1);
            }
            if (patch.half && column == 0) {
                x = 0;
            }
            const double r2 = std::min(1.0, x * x + y * y);
            position(patch.at(column, row)) = frame.origin + frame.across * (radiusAcross * x) +
                                              frame.along * (radiusAlong * y) + frame.out * (dome * (1 - r2));
        }
    }
}

Patch Cage::beginShell(int columns, int rows, const Frame& frame, double radiusAcross, double radiusAlong,
                       double dome) {
    shell = ++shells;
    Patch underside;
    Patch top = seed(columns, rows, false, underside);
    placeDisk(underside, frame, radiusAcross, radiusAlong, -dome);
    placeDisk(top, frame, radiusAcross, radiusAlong, 0);
    return top;
}

void Cage::mirror() {
    const size_t count = points.size();
    std::vector<int> image(count);
    std::map<int, int> shellImage{{0, 0}};
    for (size_t i = 0; i < count; ++i) {
        if (points[i].position.x == 0.0) {
            image[i] = static_cast<int>(i);
            continue;
        }
        Point reflected = points[i];
        reflected.position.x = -reflected.position.x;
        if (!shellImage.count(reflected.shell)) {
            shellImage[reflected.shell] = ++shells;
        }
        reflected.shell = shellImage[reflected.shell];
        image[i] = static_cast<int>(points.size());
        points.push_back(reflected);
    }
    const size_t quadCount = quads.size();
    for (size_t q = 0; q < quadCount; ++q) {
        Quad reflected = quads[q];
        for (int i = 0; i < 4; ++i) {
            reflected.points[i] = image[static_cast<size_t>(quads[q].points[3 - i])];
        }
        quads.push_back(reflected);
    }
}

void Cage::compact() {
    std::vector<int> place(points.size(), -1);
    for (const Quad& quad : quads) {
        for (int point : quad.points) {
            place[static_cast<size_t>(point)] = 0;
        }
    }
    std::vector<Point> kept;
    for (size_t i = 0; i < points.size(); ++i) {
        if (place[i] == 0) {
            place[i] = static_cast<int>(kept.size());
            kept.push_back(points[i]);
        }
    }
    for (Quad& quad : quads) {
        for (int& point : quad.points) {
            point = place[static_cast<size_t>(point)];
        }
    }
    points = kept;
}

std::vector<Vec3> Cage::limits() const {
    // (n^2 v + 4 sum(edge neighbours) + sum(face diagonals)) / (n (n + 5)); each quad at a corner adds its diagonal
    // once and half of each of its two edge neighbours.
    std::vector<Vec3> sum(points.size(), Vec3(0));
    std::vector<int> valence(points.size(), 0);
    for (const Quad& quad : quads) {
        for (size_t i = 0; i < 4; ++i) {
            const size_t p = static_cast<size_t>(quad.points[i]);
            sum[p] += 2.0 * (position(quad.points[(i + 1) % 4]) + position(quad.points[(i + 3) % 4])) +
                      position(quad.points[(i + 2) % 4]);
            ++valence[p];
        }
    }
    std::vector<Vec3> result(points.size());
    for (size_t i = 0; i < points.size(); ++i) {
        const double n = valence[i];
        result[i] = (n * n * points[i].position + sum[i]) / (n * (n + 5));
    }
    return result;
}

std::vector<std::vector<int>> Cage::neighbours() const {
    std::vector<std::vector<int>> lists(points.size());
    for (const Quad& quad : quads) {
        for (size_t i = 0; i < 4; ++i) {
            lists[static_cast<size_t>(quad.points[i])].push_back(quad.points[(i + 1) % 4]);
        }
    }
    for (std::vector<int>& list : lists) {
        std::sort(list.begin(), list.end());
    }
    return lists;
}

const char* faultOf(const Cage& cage) {
    std::map<std::pair<int, int>, int> next;
    for (const Quad& quad : cage.quads) {
        for (size_t i = 0; i < 4; ++i) {
            const int a = quad.points[i];
            const int b = quad.points[(i + 1) % 4];
            if (a == b || a == quad.points[(i + 2) % 4]) {
                return "a quad repeats a point";
            }
            if (++next[{a, b}] > 1) {
                return "an edge is used twice in one direction";
            }
        }
    }
    for (const auto& [edge, count] : next) {
        if (!next.count({edge.second, edge.first})) {
            return "the cage is open";
        }
    }
    // Walking round a point must meet all its quads, or it is a bow tie.
    std::vector<std::map<int, int>> turn(cage.points.size());
    for (const Quad& quad : cage.quads) {
        for (size_t i = 0; i < 4; ++i) {
            turn[static_cast<size_t>(quad.points[i])][quad.points[(i + 1) % 4]] = quad.points[(i + 3) % 4];
        }
    }
    for (const auto& fan : turn) {
        if (fan.size() < 3) {
            return "a point has fewer than three quads";
        }
        size_t steps = 0;
        int at = fan.begin()->first;
        do {
            at = fan.at(at);
            ++steps;
        } while (at != fan.begin()->first && steps <= fan.size());
        if (steps != fan.size()) {
            return "a point is a bow tie";
        }
    }
    for (size_t i = 0; i < cage.points.size(); ++i) {
        for (size_t k = i + 1; k < cage.points.size(); ++k) {
            const Vec3 d = cage.points[i].position - cage.points[k].position;
            if (glm::dot(d, d) < 1e-9) {
                return "two points coincide";
            }
        }
    }
    return nullptr;
}

} // namespace supple::creature
