#include "cage/repair/draft.h"

#include <algorithm>

namespace supple::cage::repair {

std::vector<uint32_t> cornerFaces(const Draft& draft) {
    std::vector<uint32_t> faces(draft.cornerCount());
    for (uint32_t f = 0; f < draft.faceCount(); ++f) {
        std::fill(faces.begin() + draft.starts[f], faces.begin() + draft.starts[f + 1], f);
    }
    return faces;
}

VertexCorners vertexCorners(const Draft& draft) {
    VertexCorners of;
    of.starts.assign(size_t{draft.vertexCount()} + 1, 0);
    for (const uint32_t v : draft.vertices) {
        ++of.starts[v + 1];
    }
    for (uint32_t v = 0; v < draft.vertexCount(); ++v) {
        of.starts[v + 1] += of.starts[v];
    }
    of.corners.resize(draft.cornerCount());
    std::vector<uint32_t> next(of.starts.begin(), of.starts.end() - 1);
    for (uint32_t c = 0; c < draft.cornerCount(); ++c) {
        of.corners[next[draft.vertices[c]]++] = c;
    }
    return of;
}

std::vector<Side> sortedSides(const Draft& draft) {
    std::vector<Side> sides;
    sides.reserve(draft.cornerCount());
    for (uint32_t f = 0; f < draft.faceCount(); ++f) {
        for (uint32_t c = draft.starts[f]; c < draft.starts[f + 1]; ++c) {
            const uint32_t a = draft.vertices[c];
            const uint32_t b = draft.vertices[draft.next(f, c)];
            sides.push_back({std::min(a, b), std::max(a, b), c, f, a < b});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
        return x.low != y.low ? x.low < y.low : x.high != y.high ? x.high < y.high : x.corner < y.corner;
    });
    return sides;
}

std::vector<uint32_t> matchSides(const Draft& draft) {
    std::vector<uint32_t> twins(draft.cornerCount(), kNone);
    const std::vector<Side> sides = sortedSides(draft);
    for (size_t i = 1; i < sides.size(); ++i) {
        if (sides[i].sameEdge(sides[i - 1])) {
            twins[sides[i].corner] = sides[i - 1].corner;
            twins[sides[i - 1].corner] = sides[i].corner;
        }
    }
    return twins;
}

} // namespace supple::cage::repair
