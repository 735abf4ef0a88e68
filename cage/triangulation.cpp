#include "cage/triangulation.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace supple::cage {
namespace {

/// Twice the area vector.
glm::dvec3 areaVector(std::span<const glm::vec3> corners) {
    const glm::dvec3 origin(corners[0]);
    glm::dvec3 area(0.0);
    for (size_t k = 1; k + 1 < corners.size(); ++k) {
        area += glm::cross(glm::dvec3(corners[k]) - origin, glm::dvec3(corners[k + 1]) - origin);
    }
    return area;
}

/// The polygon seen along its area vector: the coordinate in which that is longest is left out. It then runs
/// counter-clockwise.
std::vector<glm::dvec2> flattened(std::span<const glm::vec3> corners) {
    const glm::dvec3 area = areaVector(corners), size = glm::abs(area);
    const int left = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    int u = (left + 1) % 3, v = (left + 2) % 3;
    if (area[left] < 0.0) {
        std::swap(u, v);
    }
    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const glm::vec3& corner : corners) {
        const glm::dvec3 relative = glm::dvec3(corner) - glm::dvec3(corners[0]);
        flat.emplace_back(relative[u], relative[v]);
    }
    return flat;
}

/// Positive if the three points turn to the left.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// What is left of a polygon while its ears are clipped.
class Outline {
public:
    explicit Outline(std::vector<glm::dvec2> points)
        : points_(std::move(points)), before_(points_.size()), after_(points_.size()), ear_(points_.size()) {
        const auto count = static_cast<uint32_t>(points_.size());
        for (uint32_t k = 0; k < count; ++k) {
            before_[k] = (k + count - 1) % count;
            after_[k] = (k + 1) % count;
        }
        for (uint32_t k = 0; k < count; ++k) {
            if (turnAt(k) <= 0.0) {
                hollow_.push_back(k);
            }
        }
        for (uint32_t k = 0; k < count; ++k) {
            ear_[k] = isEar(k) ? 1 : 0;
        }
    }

    void clip(std::vector<uint32_t>& triangles) {
        auto left = static_cast<uint32_t>(points_.size());
        uint32_t at = 1;
        for (; left > 3; --left) {
            at = nextEar(at, left);
            const uint32_t before = before_[at], after = after_[at];
            triangles.insert(triangles.end(), {before, at, after});
            after_[before] = after;
            before_[after] = before;
            ear_[before] = isEar(before) ? 1 : 0;
            ear_[after] = isEar(after) ? 1 : 0;
            at = after;
        }
        triangles.insert(triangles.end(), {before_[at], at, after_[at]});
    }

private:
    [[nodiscard]] double turnAt(uint32_t k) const { return turn(points_[before_[k]], points_[k], points_[after_[k]]); }

    /// A corner that was never hollow lies in no ear, and clipping makes none hollow. Corners in the same place as one
    /// of the ear's are no obstacle: a polygon may touch itself.
    [[nodiscard]] bool isEar(uint32_t k) const {
        const glm::dvec2 &a = points_[before_[k]], &b = points_[k], &c = points_[after_[k]];
        if (turn(a, b, c) <= 0.0) {
            return false;
        }
        return std::none_of(hollow_.begin(), hollow_.end(), [&](uint32_t other) {
            const glm::dvec2& p = points_[other];
            return p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
        });
    }

    /// The next ear from `at` on. A polygon that crosses itself or is a line may have none: then the next corner that
    /// is not hollow, or any.
    [[nodiscard]] uint32_t nextEar(uint32_t at, uint32_t left) const {
        uint32_t convex = kNone, k = at;
        for (uint32_t tries = 0; tries < left; ++tries, k = after_[k]) {
            if (ear_[k] != 0) {
                return k;
            }
            if (convex == kNone && turnAt(k) > 0.0) {
                convex = k;
            }
        }
        return convex == kNone ? at : convex;
    }

    std::vector<glm::dvec2> points_;
    std::vector<uint32_t> before_, after_;
    std::vector<uint32_t> hollow_; ///< corners that turn to the right, also those that are clipped
    std::vector<uint8_t> ear_;
};

} // namespace

void clipEars(std::span<const glm::vec3> corners, std::vector<uint32_t>& triangles) {
    if (corners.size() > 3 && corners.size() <= kMostClippedSides) {
        Outline(flattened(corners)).clip(triangles);
        return;
    }
    for (uint32_t k = 1; k + 1 < corners.size(); ++k) {
        triangles.insert(triangles.end(), {0, k, k + 1});
    }
}

bool foldsOver(std::span<const glm::vec3> corners, std::span<const uint32_t> triangles) {
    const glm::dvec3 area = areaVector(corners);
    for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
        const glm::vec3 triangle[] = {corners[triangles[t]], corners[triangles[t + 1]], corners[triangles[t + 2]]};
        if (glm::dot(areaVector(triangle), area) < 0.0) {
            return true;
        }
    }
    return false;
}

std::vector<uint32_t> triangulate(const Cage& cage) {
    const size_t count = size_t{3} * (cage.cornerCount() - size_t{2} * cage.faceCount());
    if (cage.faceTriangles.size() == count) {
        return cage.faceTriangles;
    }
    std::vector<uint32_t> triangles;
    triangles.reserve(count);
    std::vector<glm::vec3> corners;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        corners.clear();
        for (uint32_t corner = cage.faceStarts[face]; corner < cage.faceStarts[face + 1]; ++corner) {
            corners.push_back(cage.positions[cage.faceVertices[corner]]);
        }
        const size_t first = triangles.size();
        clipEars(corners, triangles);
        for (size_t i = first; i < triangles.size(); ++i) {
            triangles[i] += cage.faceStarts[face];
        }
    }
    return triangles;
}

FileTriangles::FileTriangles(std::span<const uint32_t> triangles, std::span<const uint32_t> welded) : welded_(welded) {
    sides_.reserve(triangles.size());
    for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
        for (size_t k = 0; k < 3; ++k) {
            sides_.push_back(
                {welded[triangles[t + k]], welded[triangles[t + (k + 1) % 3]], welded[triangles[t + (k + 2) % 3]]});
        }
    }
    std::sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) {
        return std::tie(a.from, a.to, a.opposite) < std::tie(b.from, b.to, b.opposite);
    });
}

bool FileTriangles::cut(std::span<const uint32_t> polygon, std::vector<uint32_t>& triangles) const {
    std::vector<uint32_t> order(polygon.size()); // corners by cage vertex
    std::iota(order.begin(), order.end(), 0u);
    const auto vertex = [&](uint32_t corner) { return welded_[polygon[corner]]; };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return vertex(a) < vertex(b); });
    const auto cornerAt = [&](uint32_t sought) {
        const auto found = std::lower_bound(order.begin(), order.end(), sought,
                                            [&](uint32_t corner, uint32_t v) { return vertex(corner) < v; });
        return found != order.end() && vertex(*found) == sought ? *found : kNone;
    };
    /// The corner between two others that a triangle joins to them, or kNone.
    const auto between = [&](uint32_t first, uint32_t last) {
        const auto key = std::pair(vertex(last), vertex(first));
        auto side = std::lower_bound(sides_.begin(), sides_.end(), key, [](const Side& a, const auto& sought) {
            return std::pair(a.from, a.to) < sought;
        });
        for (; side != sides_.end() && std::pair(side->from, side->to) == key; ++side) {
            const uint32_t corner = cornerAt(side->opposite);
            if (corner != kNone && first < corner && corner < last) {
                return corner;
            }
        }
        return kNone;
    };
    const size_t before = triangles.size();
    std::vector<std::pair<uint32_t, uint32_t>> chains{{0u, static_cast<uint32_t>(polygon.size() - 1)}};
    while (!chains.empty()) {
        const auto [first, last] = chains.back();
        chains.pop_back();
        if (last - first < 2) {
            continue;
        }
        const uint32_t middle = between(first, last);
        if (middle == kNone) {
            triangles.resize(before);
            return false;
        }
        triangles.insert(triangles.end(), {first, middle, last});
        chains.emplace_back(middle, last);
        chains.emplace_back(first, middle);
    }
    return true;
}

} // namespace supple::cage
