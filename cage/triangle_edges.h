// The edges of triangles whose vertices have been welded.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace supple::cage {

/// The half-edges of triangles over welded vertices: half-edge e runs from triangles[e] to the next corner of its
/// triangle.
struct TriangleEdges {
    std::span<const uint32_t> triangles;
    std::span<const uint32_t> welded;

    [[nodiscard]] static size_t next(size_t e) { return e % 3 == 2 ? e - 2 : e + 1; }
    [[nodiscard]] uint32_t from(size_t e) const { return welded[triangles[e]]; }
    [[nodiscard]] uint32_t to(size_t e) const { return welded[triangles[next(e)]]; }
    [[nodiscard]] std::pair<uint32_t, uint32_t> edge(size_t e) const { return std::minmax(from(e), to(e)); }

    /// Whether two corners of a triangle are one welded vertex.
    [[nodiscard]] bool isDegenerate(size_t triangle) const;
    /// The half-edges of all triangles that are not degenerate, edge after edge, rising within one.
    [[nodiscard]] std::vector<size_t> sorted() const;
    /// Calls use(sides) with the half-edges of each edge of sorted().
    template <typename Use>
    void forEachEdge(const Use& use) const {
        const std::vector<size_t> edges = sorted();
        for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
            while (end < edges.size() && edge(edges[end]) == edge(edges[begin])) {
                ++end;
            }
            use(std::span(edges).subspan(begin, end - begin));
        }
    }
};

} // namespace supple::cage
