#include "cage/triangle_edges.h"

#include <algorithm>

namespace supple::cage {

bool TriangleEdges::isDegenerate(size_t triangle) const {
    const uint32_t a = from(3 * triangle);
    const uint32_t b = from(3 * triangle + 1);
    const uint32_t c = from(3 * triangle + 2);
    return a == b || b == c || c == a;
}

std::vector<size_t> TriangleEdges::sorted() const {
    std::vector<size_t> edges;
    edges.reserve(triangles.size());
    for (size_t t = 0; t < triangles.size() / 3; ++t) {
        if (!isDegenerate(t)) {
            edges.insert(edges.end(), {3 * t, 3 * t + 1, 3 * t + 2});
        }
    }
    std::sort(edges.begin(), edges.end(),
              [&](size_t x, size_t y) { return std::pair(edge(x), x) < std::pair(edge(y), y); });
    return edges;
}

} // namespace supple::cage
