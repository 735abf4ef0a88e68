#include "cage/repair/rings.h"

#include "cage/triangle_edges.h"
#include "cage/triangle_pairs.h"
#include "cage/triangulation.h"

#include <algorithm>
#include <set>
#include <utility>

namespace supple::cage::repair {
namespace {

using Corners = std::vector<uint32_t>; ///< of the cage

/// One face that passes vertices twice.
class RingFace {
public:
    RingFace(const Cage& cage, uint32_t face) : cage_(cage) {
        for (uint32_t c = cage.faceStarts[face]; c < cage.faceStarts[face + 1]; ++c) {
            pass(c);
        }
        closeUp();
    }

    /// It has a side both ways, and one of its loops is a hole in another one.
    [[nodiscard]] bool goesRoundHoles() const {
        if (corners_.size() > kMostClippedSides || !hasBridge()) {
            return false;
        }
        const std::vector<Corners> loops = loopsOf();
        glm::dvec3 area(0.0);
        for (const Corners& loop : loops) {
            area += areaOf(loop);
        }
        bool hasHole = false;
        for (const Corners& hole : loops) {
            if (glm::dot(areaOf(hole), area) >= 0.0) {
                continue;
            }
            hasHole = std::any_of(loops.begin(), loops.end(), [&](const Corners& outer) {
                return glm::dot(areaOf(outer), area) > 0.0 && isInside(hole[0], outer, area);
            });
            if (!hasHole) {
                return false;
            }
        }
        return hasHole;
    }

    /// Quads and triangles of numbers of corners(); none if it cannot be cut without folds.
    [[nodiscard]] Polygons cut() const {
        std::vector<glm::vec3> positions;
        Corners vertices;
        for (const uint32_t corner : corners_) {
            positions.push_back(position(corner));
            vertices.push_back(vertex(corner));
        }
        Corners sorted = vertices;
        std::sort(sorted.begin(), sorted.end());
        for (uint32_t& v : vertices) {
            v = static_cast<uint32_t>(std::lower_bound(sorted.begin(), sorted.end(), v) - sorted.begin());
        }
        std::vector<uint32_t> triangles;
        clipEars(positions, triangles);
        if (foldsOver(positions, triangles) || !isSurface(triangles, vertices)) {
            return {};
        }
        const auto same = [](uint32_t a, uint32_t b) { return a == b; }; // so bridges stay edges
        std::vector<uint32_t> spare = spareEdges(triangles, vertices);
        return pairTriangles(triangles, vertices, positions, same, PairShape::clean, spare).polygons;
    }

    [[nodiscard]] const Corners& corners() const { return corners_; }

private:
    [[nodiscard]] uint32_t vertex(uint32_t corner) const { return cage_.faceVertices[corner]; }
    [[nodiscard]] const glm::vec3& position(uint32_t corner) const { return cage_.positions[vertex(corner)]; }

    /// Where the face turns back on the spot, from a vertex to the one before it, there is nothing between.
    void pass(uint32_t corner) {
        const size_t n = corners_.size();
        if (n > 0 && vertex(corners_[n - 1]) == vertex(corner)) {
            return;
        }
        if (n > 1 && vertex(corners_[n - 2]) == vertex(corner)) {
            corners_.pop_back();
            return;
        }
        corners_.push_back(corner);
    }
    /// The same where the end meets the beginning.
    void closeUp() {
        size_t first = 0, end = corners_.size();
        const auto at = [&](size_t i) { return vertex(corners_[i]); };
        while (end - first > 2) {
            if (at(end - 1) == at(first) || at(end - 2) == at(first)) {
                --end;
            } else if (at(end - 1) == at(first + 1)) {
                ++first;
            } else {
                break;
            }
        }
        corners_ = Corners(corners_.begin() + static_cast<std::ptrdiff_t>(first),
                           corners_.begin() + static_cast<std::ptrdiff_t>(end));
    }

    [[nodiscard]] bool hasBridge() const {
        std::set<std::pair<uint32_t, uint32_t>> sides;
        for (size_t i = 0; i < corners_.size(); ++i) {
            const uint32_t from = vertex(corners_[i]), to = vertex(corners_[(i + 1) % corners_.size()]);
            if (sides.contains({to, from})) {
                return true;
            }
            sides.emplace(from, to);
        }
        return false;
    }

    /// What lies between two passages of a vertex, but for the bridges.
    [[nodiscard]] std::vector<Corners> loopsOf() const {
        std::vector<Corners> loops;
        Corners open;
        const auto takeFrom = [&](Corners::iterator first) {
            if (open.end() - first >= 3) {
                loops.emplace_back(first, open.end());
            }
            open.erase(first, open.end());
        };
        for (const uint32_t corner : corners_) {
            const auto passed =
                std::find_if(open.begin(), open.end(), [&](uint32_t other) { return vertex(other) == vertex(corner); });
            if (passed != open.end()) {
                takeFrom(passed);
            }
            open.push_back(corner);
        }
        takeFrom(open.begin());
        return loops;
    }

    [[nodiscard]] glm::dvec3 areaOf(const Corners& loop) const {
        const glm::dvec3 origin(position(loop[0]));
        glm::dvec3 area(0.0);
        for (size_t k = 1; k + 1 < loop.size(); ++k) {
            area += glm::cross(glm::dvec3(position(loop[k])) - origin, glm::dvec3(position(loop[k + 1])) - origin);
        }
        return area;
    }

    /// Seen along `area`.
    [[nodiscard]] bool isInside(uint32_t corner, const Corners& outer, const glm::dvec3& area) const {
        const glm::dvec3 size = glm::abs(area);
        const int left = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        const int u = (left + 1) % 3, v = (left + 2) % 3;
        const glm::dvec3 p(position(corner));
        bool inside = false;
        for (size_t k = 0; k < outer.size(); ++k) {
            const glm::dvec3 a(position(outer[k])), b(position(outer[(k + 1) % outer.size()]));
            if ((a[v] > p[v]) != (b[v] > p[v]) && p[u] < a[u] + (p[v] - a[v]) / (b[v] - a[v]) * (b[u] - a[u])) {
                inside = !inside;
            }
        }
        return inside;
    }

    /// Every edge has one triangle or two, which run against each other there.
    [[nodiscard]] static bool isSurface(const std::vector<uint32_t>& triangles, const Corners& vertices) {
        const TriangleEdges edges{triangles, vertices};
        bool sound = true;
        for (size_t t = 0; t < triangles.size() / 3; ++t) {
            sound = sound && !edges.isDegenerate(t);
        }
        edges.forEachEdge([&](std::span<const size_t> sides) {
            sound = sound && (sides.size() == 1 || (sides.size() == 2 && edges.from(sides[0]) == edges.to(sides[1])));
        });
        return sound;
    }

    const Cage& cage_;
    Corners corners_;
};

} // namespace

bool addRing(const Cage& cage, uint32_t face, Draft& draft) {
    const RingFace ring(cage, face);
    if (!ring.goesRoundHoles()) {
        return false;
    }
    const Polygons polygons = ring.cut();
    for (size_t p = 0; p < polygons.faceCount(); ++p) {
        for (uint32_t k = polygons.starts[p]; k < polygons.starts[p + 1]; ++k) {
            const uint32_t corner = ring.corners()[polygons.vertices[k]];
            draft.addCorner(cage.faceVertices[corner], corner);
        }
        draft.closeFace(face);
    }
    return polygons.faceCount() > 0;
}

} // namespace supple::cage::repair
