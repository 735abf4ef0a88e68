#include "cage/weld.h"

#include "cage/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace supple::cage {
namespace {

Welding rootsOf(DisjointSets& sets, size_t vertexCount) {
    Welding welding;
    welding.roots.resize(vertexCount);
    for (uint32_t v = 0; v < vertexCount; ++v) {
        welding.roots[v] = sets.find(v);
    }
    return welding;
}

struct HalfEdge {
    uint32_t low = 0; ///< candidate sets at the ends, low < high
    uint32_t high = 0;
    uint32_t lowVertex = 0;
    uint32_t highVertex = 0;
    uint32_t face = 0;
    bool forward = false; ///< low -> high
};

std::vector<HalfEdge> halfEdges(std::span<const uint32_t> candidates, const Polygons& faces) {
    std::vector<HalfEdge> edges;
    edges.reserve(faces.vertices.size());
    for (uint32_t f = 0; f < faces.faceCount(); ++f) {
        for (uint32_t c = faces.starts[f]; c < faces.starts[f + 1]; ++c) {
            const uint32_t from = faces.vertices[c];
            const uint32_t to = faces.vertices[c + 1 < faces.starts[f + 1] ? c + 1 : faces.starts[f]];
            const uint32_t a = candidates[from];
            const uint32_t b = candidates[to];
            if (a != b) {
                edges.push_back(a < b ? HalfEdge{a, b, from, to, f, true} : HalfEdge{b, a, to, from, f, false});
            }
        }
    }
    std::sort(edges.begin(), edges.end(),
              [](const HalfEdge& x, const HalfEdge& y) { return std::pair(x.low, x.high) < std::pair(y.low, y.high); });
    return edges;
}

/// Sews two half-edges when they are all of their group.
bool sewOnlyPair(std::span<const HalfEdge> group, const MayJoin& mayJoin, DisjointSets& sets) {
    if (group.size() != 2 || group[0].forward == group[1].forward || group[0].face == group[1].face ||
        !mayJoin(group[0].face, group[1].face))
        return false;
    const bool low = sets.unite(group[0].lowVertex, group[1].lowVertex);
    const bool high = sets.unite(group[0].highVertex, group[1].highVertex);
    return low || high;
}

/// Sews what is unambiguous among the half-edges between two candidate sets: first those the file joins already are set
/// aside; of the rest a lone pair, or a lone pair among those that share one end.
bool sewGroup(std::span<const HalfEdge> group, const MayJoin& mayJoin, DisjointSets& sets, std::vector<HalfEdge>& open,
              std::vector<HalfEdge>& part) {
    open.clear();
    const auto key = [&](const HalfEdge& e) { return std::pair(sets.find(e.lowVertex), sets.find(e.highVertex)); };
    open.assign(group.begin(), group.end());
    std::sort(open.begin(), open.end(), [&](const HalfEdge& x, const HalfEdge& y) { return key(x) < key(y); });
    part.clear();
    for (size_t begin = 0; begin < open.size();) {
        size_t end = begin;
        size_t forward = 0;
        for (; end < open.size() && key(open[end]) == key(open[begin]); ++end)
            forward += open[end].forward ? 1 : 0;
        // As many each way: joined. Otherwise all of them stay in play.
        if (2 * forward != end - begin)
            part.insert(part.end(), open.begin() + static_cast<ptrdiff_t>(begin),
                        open.begin() + static_cast<ptrdiff_t>(end));
        begin = end;
    }
    open.swap(part);
    if (open.size() < 2)
        return false;
    if (open.size() == 2)
        return sewOnlyPair(open, mayJoin, sets);
    for (const bool byLow : {true, false}) {
        const auto end = [&](const HalfEdge& e) { return sets.find(byLow ? e.lowVertex : e.highVertex); };
        std::sort(open.begin(), open.end(), [&](const HalfEdge& x, const HalfEdge& y) { return end(x) < end(y); });
        for (size_t first = 0; first < open.size();) {
            size_t last = first;
            const uint32_t root = end(open[first]);
            while (last < open.size() && end(open[last]) == root)
                ++last;
            part.assign(open.begin() + static_cast<ptrdiff_t>(first), open.begin() + static_cast<ptrdiff_t>(last));
            first = last;
            if (sewOnlyPair(part, mayJoin, sets))
                return true; // roots moved: the caller looks again
        }
    }
    return false;
}

// What merges can do to faces. Each calls `blame` with the cage vertices that may have to be taken apart again.

std::span<const uint32_t> faceOf(const Polygons& polygons, size_t f) {
    return std::span(polygons.vertices).subspan(polygons.starts[f], polygons.starts[f + 1] - polygons.starts[f]);
}

/// A face that passes a cage vertex twice.
template <class Blame>
void blameRepeats(const Polygons& polygons, std::span<const uint32_t> roots, const Blame& blame) {
    std::vector<uint32_t> sorted;
    for (size_t f = 0; f < polygons.faceCount(); ++f) {
        sorted.clear();
        for (const uint32_t vertex : faceOf(polygons, f))
            sorted.push_back(roots[vertex]);
        std::sort(sorted.begin(), sorted.end());
        for (size_t j = 1; j < sorted.size(); ++j)
            if (sorted[j] == sorted[j - 1])
                blame(sorted[j]);
    }
}

/// An edge that runs twice in one direction, between vertices that were several.
template <class Blame>
void blameDoubledEdges(const Polygons& polygons, std::span<const uint32_t> roots, const Blame& blame) {
    struct Edge {
        uint32_t from, to;             ///< cage vertices
        uint32_t fromVertex, toVertex; ///< the file's
    };
    std::vector<Edge> edges;
    edges.reserve(polygons.vertices.size());
    for (size_t f = 0; f < polygons.faceCount(); ++f) {
        const std::span<const uint32_t> face = faceOf(polygons, f);
        for (size_t j = 0; j < face.size(); ++j) {
            const uint32_t next = face[(j + 1) % face.size()];
            edges.push_back({roots[face[j]], roots[next], face[j], next});
        }
    }
    std::sort(edges.begin(), edges.end(),
              [](const Edge& x, const Edge& y) { return std::pair(x.from, x.to) < std::pair(y.from, y.to); });
    for (size_t i = 1; i < edges.size(); ++i) {
        const Edge& x = edges[i - 1];
        const Edge& y = edges[i];
        if (x.from == y.from && x.to == y.to) {
            if (x.fromVertex != y.fromVertex)
                blame(x.from);
            if (x.toVertex != y.toVertex)
                blame(x.to);
        }
    }
}

/// An interior vertex of valence two: its two faces lie on each other.
template <class Blame>
void blameFolds(const Polygons& polygons, std::span<const uint32_t> roots, const Blame& blame) {
    // Per cage vertex: its corners, and for the first two of them the neighbors before and after.
    std::vector<uint32_t> corners(roots.size(), 0);
    std::vector<std::array<uint32_t, 4>> around(roots.size());
    for (size_t f = 0; f < polygons.faceCount(); ++f) {
        const std::span<const uint32_t> face = faceOf(polygons, f);
        for (size_t j = 0; j < face.size(); ++j) {
            const uint32_t root = roots[face[j]];
            const uint32_t seen = corners[root]++;
            if (seen < 2) {
                around[root][2 * seen] = roots[face[(j + face.size() - 1) % face.size()]];
                around[root][2 * seen + 1] = roots[face[(j + 1) % face.size()]];
            }
        }
    }
    for (uint32_t v = 0; v < roots.size(); ++v)
        if (corners[v] == 2 && around[v][0] == around[v][3] && around[v][1] == around[v][2])
            blame(v);
}

} // namespace

Welding weld(std::span<const uint32_t> candidates, const Polygons& faces, const MayJoin& mayJoin) {
    DisjointSets sets(candidates.size());
    const std::vector<HalfEdge> edges = halfEdges(candidates, faces);
    std::vector<HalfEdge> open;
    std::vector<HalfEdge> part;

    // Lone pairs first, then whatever they disambiguate, until nothing moves. Every further round needs a merge that
    // the round before made, and rounds are bounded so that no file can make this quadratic.
    constexpr int kMaxRounds = 64;
    std::vector<std::span<const HalfEdge>> groups;
    for (size_t begin = 0; begin < edges.size();) {
        size_t end = begin;
        while (end < edges.size() && edges[end].low == edges[begin].low && edges[end].high == edges[begin].high)
            ++end;
        const auto group = std::span(edges).subspan(begin, end - begin);
        begin = end;
        if (group.size() == 2)
            sewOnlyPair(group, mayJoin, sets);
        else if (group.size() > 2)
            groups.push_back(group);
    }
    bool moved = !groups.empty();
    for (int round = 0; round < kMaxRounds && moved; ++round) {
        moved = false;
        for (const auto group : groups)
            moved = sewGroup(group, mayJoin, sets, open, part) || moved;
    }

    return rootsOf(sets, candidates.size());
}

bool lieBackToBack(std::span<const glm::vec3> positions, const Polygons& faces, uint32_t face, uint32_t other) {
    constexpr double kCosineOf179Degrees = -0.99984770;
    const auto areaOf = [&](uint32_t f) {
        const std::span<const uint32_t> vertices = faceOf(faces, f);
        const glm::dvec3 origin(positions[vertices[0]]);
        glm::dvec3 area(0.0);
        for (size_t k = 1; k + 1 < vertices.size(); ++k) {
            area += glm::cross(glm::dvec3(positions[vertices[k]]) - origin,
                               glm::dvec3(positions[vertices[k + 1]]) - origin);
        }
        return area;
    };
    const glm::dvec3 a = areaOf(face), b = areaOf(other);
    const double lengths = glm::length(a) * glm::length(b);
    return lengths > 0.0 && glm::dot(a, b) < kCosineOf179Degrees * lengths;
}

Welding weldPairs(size_t vertexCount, std::span<const std::pair<uint32_t, uint32_t>> pairs) {
    DisjointSets sets(vertexCount);
    for (const auto& [a, b] : pairs) {
        sets.unite(a, b);
    }
    return rootsOf(sets, vertexCount);
}

uint32_t unweldDefects(const Polygons& polygons, Welding& welding) {
    auto& roots = welding.roots;
    std::vector<uint8_t> merged(roots.size(), 0);
    for (uint32_t v = 0; v < roots.size(); ++v)
        if (roots[v] != v)
            merged[roots[v]] = 1;

    std::vector<uint8_t> bad(roots.size(), 0);
    uint32_t takenApart = 0;
    constexpr int kMaxRounds = 16; // each takes apart at least one cage vertex, in practice all of them at once
    for (int round = 0; round < kMaxRounds; ++round) {
        std::fill(bad.begin(), bad.end(), uint8_t{0});
        bool any = false;
        const auto blame = [&](uint32_t vertex) {
            if (merged[vertex] != 0) {
                bad[vertex] = 1;
                any = true;
            }
        };
        blameRepeats(polygons, roots, blame);
        blameDoubledEdges(polygons, roots, blame);
        blameFolds(polygons, roots, blame);
        if (!any)
            break;
        for (uint32_t v = 0; v < roots.size(); ++v) {
            const uint32_t root = roots[v];
            if (bad[root] != 0) {
                takenApart += v == root ? 1 : 0;
                roots[v] = v;
                if (v == root)
                    merged[v] = 0;
            }
        }
        // A root is the smallest member and comes first, so `bad[root]` was still read by the others above.
    }
    return takenApart;
}

} // namespace supple::cage
