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
    faces.push_back({{a, b, c, d}, part});
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
    const size_t firstTop = faces.size() - 2 * static_cast<size_t>(columns * rows);
    std::map<int, int> renamed;
    for (size_t i = 0; i < fresh.size(); ++i) {
        renamed[top.points[i]] = fresh[i];
    }
    std::set<std::pair<int, int>> directed;
    for (size_t q = firstTop; q < firstTop + static_cast<size_t>(columns * rows); ++q) {
        for (size_t i = 0; i < 4; ++i) {
            directed.insert({faces[q].points[i], faces[q].points[(i + 1) % 4]});
        }
        for (int& point : faces[q].points) {
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
    for (size_t q = 0; q < faces.size(); ++q) {
        std::vector<int> have = faces[q].points;
        std::sort(have.begin(), have.end());
        if (std::equal(have.begin(), have.end(), wanted.begin(), wanted.end())) {
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
            Face& face = faces[static_cast<size_t>(q)];
            for (size_t i = 0; i < 4; ++i) {
                edges.push_back({face.points[i], face.points[(i + 1) % 4]});
                directed.insert(edges.back());
            }
            for (int& point : face.points) {
                point = renamed[point];
            }
            face.part = part;
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

std::vector<int> Cage::rimOf(const Patch& patch) {
    std::vector<int> rim;
    for (int column = 0; column < patch.columns; ++column) {
        rim.push_back(patch.at(column, 0));
    }
    for (int row = 0; row < patch.rows; ++row) {
        rim.push_back(patch.at(patch.columns, row));
    }
    for (int column = patch.columns; column > 0; --column) {
        rim.push_back(patch.at(column, patch.rows));
    }
    if (patch.half) {
        rim.push_back(patch.at(0, patch.rows));
        return rim;
    }
    for (int row = patch.rows; row > 0; --row) {
        rim.push_back(patch.at(0, row));
    }
    return rim;
}

int Cage::fan(const Patch& patch, const Vec3& tip) {
    open(patch);
    const int apex = addPoint(tip);
    points.back().along = points[static_cast<size_t>(patch.points.front())].along;
    const std::vector<int> rim = rimOf(patch);
    for (size_t i = 0; i + (patch.half ? 1 : 0) < rim.size(); ++i) {
        faces.push_back({{rim[i], rim[(i + 1) % rim.size()], apex}, part});
    }
    return apex;
}

void Cage::open(const Patch& patch) {
    std::set<size_t> gone;
    for (int row = 0; row < patch.rows; ++row) {
        for (int column = 0; column < patch.columns; ++column) {
            gone.insert(static_cast<size_t>(findQuad({patch.at(column, row), patch.at(column + 1, row),
                                                      patch.at(column + 1, row + 1), patch.at(column, row + 1)})));
        }
    }
    for (auto it = gone.rbegin(); it != gone.rend(); ++it) {
        faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(*it));
    }
}

size_t Cage::faceAlong(int a, int b) const {
    for (size_t f = 0; f < faces.size(); ++f) {
        const std::vector<int>& p = faces[f].points;
        for (size_t i = 0; i < p.size(); ++i) {
            if (p[i] == a && p[(i + 1) % p.size()] == b) {
                return f;
            }
        }
    }
    fail("an edge is named that the cage has not got");
}

void Cage::dissolve(const std::vector<int>& chain) {
    for (size_t i = 0; i + 1 < chain.size(); ++i) {
        const size_t keep = faceAlong(chain[i], chain[i + 1]);
        const size_t lose = faceAlong(chain[i + 1], chain[i]);
        // Each from the far end of the edge round to its near end; the shared ends once.
        std::vector<int> merged = faces[keep].points;
        std::rotate(merged.begin(), std::find(merged.begin(), merged.end(), chain[i + 1]), merged.end());
        std::vector<int> rest = faces[lose].points;
        std::rotate(rest.begin(), std::find(rest.begin(), rest.end(), chain[i]), rest.end());
        merged.insert(merged.end(), rest.begin() + 1, rest.end() - 1);
        faces[keep].points = merged;
        faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(lose));
    }
    const std::vector<std::vector<int>> around = neighbours();
    for (int point : chain) {
        if (around[static_cast<size_t>(point)].size() == 2) {
            for (Face& face : faces) {
                std::erase(face.points, point);
            }
        }
    }
}

void Cage::widen(int before, int a, int b, int after, double width) {
    const size_t right = faceAlong(b, a);
    const Vec3 across = glm::normalize(centre(faces[right]) - centre(faces[faceAlong(a, b)])) * (width / 2);
    const auto twin = [&](int point) {
        points.push_back(points[static_cast<size_t>(point)]);
        points.back().position += across;
        position(point) -= across;
        return static_cast<int>(points.size()) - 1;
    };
    // All faces on the right, from the edge round to its continuation.
    std::vector<size_t> atA;
    std::vector<size_t> atB;
    const auto beside = [&](size_t face, int point, size_t step) {
        const std::vector<int>& p = faces[face].points;
        const size_t i = static_cast<size_t>(std::find(p.begin(), p.end(), point) - p.begin());
        return p[(i + step) % p.size()];
    };
    size_t face = right;
    for (int spoke = beside(face, a, 1); atA.push_back(face), spoke != before; spoke = beside(face, a, 1)) {
        face = faceAlong(spoke, a);
    }
    face = right;
    for (int spoke = beside(face, b, faces[face].points.size() - 1); atB.push_back(face), spoke != after;
         spoke = beside(face, b, faces[face].points.size() - 1)) {
        face = faceAlong(b, spoke);
    }
    const int a2 = twin(a);
    const int b2 = twin(b);
    for (const size_t f : atA) {
        std::replace(faces[f].points.begin(), faces[f].points.end(), a, a2);
    }
    for (const size_t f : atB) {
        std::replace(faces[f].points.begin(), faces[f].points.end(), b, b2);
    }
    addQuad(b, a, a2, b2);
    faces.push_back({{a, before, a2}, part});
    faces.push_back({{after, b, b2}, part});
}

void Cage::crease(int a, int b, float sharpness) {
    creases[{std::min(a, b), std::max(a, b)}] = sharpness;
}

void Cage::creaseChain(const std::vector<int>& chain, float sharpness) {
    for (size_t i = 0; i + 1 < chain.size(); ++i) {
        crease(chain[i], chain[i + 1], sharpness);
    }
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
    const size_t faceCount = faces.size();
    for (size_t q = 0; q < faceCount; ++q) {
        Face reflected = faces[q];
        std::reverse(reflected.points.begin(), reflected.points.end());
        std::reverse(reflected.uvs.begin(), reflected.uvs.end());
        for (int& point : reflected.points) {
            point = image[static_cast<size_t>(point)];
        }
        faces.push_back(reflected);
    }
    const std::map<std::pair<int, int>, float> half = creases;
    for (const auto& [edge, sharpness] : half) {
        crease(image[static_cast<size_t>(edge.first)], image[static_cast<size_t>(edge.second)], sharpness);
    }
}

void Cage::compact() {
    std::vector<int> place(points.size(), -1);
    for (const Face& face : faces) {
        for (int point : face.points) {
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
    for (Face& face : faces) {
        for (int& point : face.points) {
            point = place[static_cast<size_t>(point)];
        }
    }
    points = kept;
    std::map<std::pair<int, int>, float> renamed;
    for (const auto& [edge, sharpness] : creases) {
        renamed[{place[static_cast<size_t>(edge.first)], place[static_cast<size_t>(edge.second)]}] = sharpness;
    }
    creases = renamed;
}

std::vector<Vec3> Cage::limits() const {
    // Inside (n^2 v + sum(2 (neighbour + neighbour) + far)) / (n (n + 5)), a term for each face at the point; far is
    // the mean of the corners two on and two back. On a boundary the cubic B-spline of its polygon.
    std::vector<Vec3> sum(points.size(), Vec3(0));
    std::vector<int> valence(points.size(), 0);
    std::map<int, int> next;
    std::map<int, int> previous;
    const std::map<std::pair<int, int>, size_t> edges = directedEdges();
    for (const auto& [edge, face] : edges) {
        if (!edges.count({edge.second, edge.first})) {
            next[edge.first] = edge.second;
            previous[edge.second] = edge.first;
        }
    }
    for (const Face& face : faces) {
        const size_t sides = face.points.size();
        for (size_t i = 0; i < sides; ++i) {
            const size_t p = static_cast<size_t>(face.points[i]);
            sum[p] += 2.0 * (position(face.points[(i + 1) % sides]) + position(face.points[(i + sides - 1) % sides])) +
                      0.5 * (position(face.points[(i + 2) % sides]) + position(face.points[(i + sides - 2) % sides]));
            ++valence[p];
        }
    }
    std::vector<Vec3> result(points.size());
    for (size_t i = 0; i < points.size(); ++i) {
        const int point = static_cast<int>(i);
        if (next.count(point)) {
            result[i] = (position(next.at(point)) + position(previous.at(point)) + 4.0 * points[i].position) / 6.0;
            continue;
        }
        const double n = valence[i];
        result[i] = (n * n * points[i].position + sum[i]) / (n * (n + 5));
    }
    return result;
}

std::map<std::pair<int, int>, size_t> Cage::directedEdges() const {
    std::map<std::pair<int, int>, size_t> edges;
    for (size_t f = 0; f < faces.size(); ++f) {
        const std::vector<int>& p = faces[f].points;
        for (size_t i = 0; i < p.size(); ++i) {
            edges[{p[i], p[(i + 1) % p.size()]}] = f;
        }
    }
    return edges;
}

Vec3 Cage::normal(const Face& face) const {
    const std::vector<int>& p = face.points;
    if (p.size() == 4) {
        return glm::cross(position(p[2]) - position(p[0]), position(p[3]) - position(p[1]));
    }
    Vec3 sum{0};
    for (size_t i = 2; i < p.size(); ++i) {
        sum += glm::cross(position(p[i - 1]) - position(p[0]), position(p[i]) - position(p[0]));
    }
    return sum;
}

Vec3 Cage::centre(const Face& face) const {
    Vec3 sum{0};
    for (int point : face.points) {
        sum += position(point) * (1.0 / static_cast<double>(face.points.size()));
    }
    return sum;
}

std::vector<std::vector<int>> Cage::neighbours() const {
    std::vector<std::set<int>> sets(points.size());
    for (const auto& [edge, face] : directedEdges()) {
        sets[static_cast<size_t>(edge.first)].insert(edge.second);
        sets[static_cast<size_t>(edge.second)].insert(edge.first);
    }
    std::vector<std::vector<int>> lists;
    for (const std::set<int>& set : sets) {
        lists.emplace_back(set.begin(), set.end());
    }
    return lists;
}

bool hasCoincidentPoints(const Cage& cage) {
    for (size_t i = 0; i < cage.points.size(); ++i) {
        for (size_t k = i + 1; k < cage.points.size(); ++k) {
            const Vec3 d = cage.points[i].position - cage.points[k].position;
            if (glm::dot(d, d) < 1e-9) {
                return true;
            }
        }
    }
    return false;
}

} // namespace supple::creature
