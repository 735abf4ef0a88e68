#include "cage/smooth_groups.h"

#include "cage/corner_normals.h"
#include "cage/disjoint_sets.h"
#include "cage/topology.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace supple::cage {
namespace {

using Edge = std::pair<uint32_t, uint32_t>; ///< smaller vertex first

/// A face's side, and its corners at the edge's smaller and larger vertex.
struct EdgeSide {
    Edge edge;
    uint32_t atSmaller = 0;
    uint32_t atLarger = 0;
};

std::vector<EdgeSide> sidesOf(const Cage& cage) {
    std::vector<EdgeSide> sides;
    sides.reserve(cage.cornerCount());
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        for (uint32_t corner = cage.faceStarts[face]; corner < cage.faceStarts[face + 1]; ++corner) {
            const uint32_t next = nextCorner(cage, face, corner);
            const uint32_t a = cage.faceVertices[corner];
            const uint32_t b = cage.faceVertices[next];
            sides.push_back(a < b ? EdgeSide{{a, b}, corner, next} : EdgeSide{{b, a}, next, corner});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const EdgeSide& x, const EdgeSide& y) {
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

} // namespace

std::vector<uint32_t> smoothGroups(const Cage& cage) {
    DisjointSets sets(cage.cornerCount());
    const std::vector<EdgeSide> sides = sidesOf(cage);
    const std::vector<Edge> hard = hardEdges(cage);
    const bool authored = !cage.cornerNormals.empty();
    const auto unite = [&](uint32_t a, uint32_t b) {
        if (!authored || normalsAgree(cage.cornerNormals[a], cage.cornerNormals[b])) {
            sets.unite(a, b);
        }
    };
    for (size_t i = 1; i < sides.size(); ++i) {
        const EdgeSide& side = sides[i];
        if (sides[i - 1].edge == side.edge && (authored || !std::binary_search(hard.begin(), hard.end(), side.edge))) {
            unite(sides[i - 1].atSmaller, side.atSmaller);
            unite(sides[i - 1].atLarger, side.atLarger);
        }
    }
    std::vector<uint32_t> groups(cage.cornerCount());
    for (uint32_t corner = 0; corner < cage.cornerCount(); ++corner) {
        groups[corner] = sets.find(corner);
    }
    return groups;
}

} // namespace supple::cage
