#include "cage/corner_normals.h"

#include "cage/topology.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>

namespace supple::cage {
namespace {

using Edge = std::pair<uint32_t, uint32_t>; ///< smaller vertex first

/// A face's side, and its corners at the edge's smaller and larger vertex.
struct Side {
    Edge edge;
    uint32_t atSmaller = 0;
    uint32_t atLarger = 0;
};

std::vector<Side> sidesOf(const Cage& cage) {
    std::vector<Side> sides;
    sides.reserve(cage.cornerCount());
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        for (uint32_t corner = cage.faceStarts[face]; corner < cage.faceStarts[face + 1]; ++corner) {
            const uint32_t next = nextCorner(cage, face, corner);
            const uint32_t a = cage.faceVertices[corner];
            const uint32_t b = cage.faceVertices[next];
            sides.push_back(a < b ? Side{{a, b}, corner, next} : Side{{b, a}, next, corner});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
        return std::tie(x.edge, x.atSmaller) < std::tie(y.edge, y.atSmaller);
    });
    return sides;
}

std::vector<Edge> hardEdges(const Cage& cage) {
    std::vector<Edge> edges;
    for (const Crease& crease : cage.creases) {
        if (crease.sharpness >= kHardSharpness) {
            edges.emplace_back(std::minmax(crease.a, crease.b));
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

/// Per corner: the smallest corner of those that share its normal.
std::vector<uint32_t> smoothGroups(const Cage& cage) {
    std::vector<uint32_t> groups(cage.cornerCount());
    std::iota(groups.begin(), groups.end(), 0u);
    const auto find = [&](uint32_t corner) {
        while (groups[corner] != corner) {
            groups[corner] = groups[groups[corner]];
            corner = groups[corner];
        }
        return corner;
    };
    const auto unite = [&](uint32_t a, uint32_t b) {
        a = find(a);
        b = find(b);
        groups[std::max(a, b)] = std::min(a, b);
    };
    const std::vector<Side> sides = sidesOf(cage);
    const std::vector<Edge> hard = hardEdges(cage);
    for (size_t i = 1; i < sides.size(); ++i) {
        const Side& side = sides[i];
        if (sides[i - 1].edge == side.edge && !std::binary_search(hard.begin(), hard.end(), side.edge)) {
            unite(sides[i - 1].atSmaller, side.atSmaller);
            unite(sides[i - 1].atLarger, side.atLarger);
        }
    }
    for (uint32_t corner = 0; corner < cage.cornerCount(); ++corner) {
        groups[corner] = find(corner);
    }
    return groups;
}

glm::dvec3 unitOr(const glm::dvec3& v, const glm::dvec3& fallback) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? v / length : fallback;
}

} // namespace

std::vector<glm::vec3> cornerNormals(const Cage& cage) {
    const std::vector<uint32_t> groups = smoothGroups(cage);
    std::vector<glm::dvec3> sums(cage.cornerCount(), glm::dvec3(0.0));
    std::vector<glm::dvec3> faceNormals;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const uint32_t first = cage.faceStarts[face];
        const uint32_t last = cage.faceStarts[face + 1];
        const auto position = [&](uint32_t corner) { return glm::dvec3(cage.positions[cage.faceVertices[corner]]); };
        glm::dvec3 area(0.0);
        for (uint32_t corner = first + 1; corner + 1 < last; ++corner) {
            area += glm::cross(position(corner) - position(first), position(corner + 1) - position(first));
        }
        const glm::dvec3 normal = unitOr(area, {0.0, 0.0, 0.0});
        faceNormals.push_back(normal);
        for (uint32_t corner = first; corner < last; ++corner) {
            const glm::dvec3 to = position(nextCorner(cage, face, corner)) - position(corner);
            const glm::dvec3 back = position(previousCorner(cage, face, corner)) - position(corner);
            const double angle = std::atan2(glm::length(glm::cross(to, back)), glm::dot(to, back));
            sums[groups[corner]] += angle * normal;
        }
    }
    std::vector<glm::vec3> normals;
    normals.reserve(cage.cornerCount());
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        // Faces without area still need a direction.
        const glm::dvec3 own = unitOr(faceNormals[face], {0.0, 1.0, 0.0});
        for (uint32_t corner = cage.faceStarts[face]; corner < cage.faceStarts[face + 1]; ++corner) {
            normals.emplace_back(unitOr(sums[groups[corner]], own));
        }
    }
    return normals;
}

} // namespace supple::cage
