#include "surface/patch_edges.h"

#include "shaders/shared/surface.h"

#include <algorithm>

namespace supple::surface {

uint32_t PatchEdges::edgeBound() const {
    uint32_t bound = 0;
    for (const PatchSide& side : sides) {
        bound = std::max(bound, side.edge + 1);
    }
    return bound;
}

uint32_t edgeNumber(const cage::Topology& topology, uint32_t corner, bool isOne) {
    const uint32_t edge = topology.cornerEdges[corner];
    const bool isFirst = topology.edges[edge].corner == corner;
    return isOne || isFirst ? edge : edge + static_cast<uint32_t>(topology.edges.size());
}

NetIndices::NetIndices(const NetCorners& corners, uint32_t tangents, uint32_t faces, bool polar) {
    using namespace shared;
    for (uint32_t k = 0; k < indices_.size(); ++k) {
        const uint32_t corner = polar ? SUPPLE_POLAR_NET_CORNER(k) : SUPPLE_NET_CORNER(k);
        const uint32_t point = corners.points[corner], spoke = corners.spokes[corner];
        const uint32_t choices[] = {point, tangents + spoke, tangents + corners.nextSpokes[corner], faces + spoke,
                                    point + 1};
        static_assert(kNetPoint == 0 && kNetTangent == 1 && kNetNextTangent == 2 && kNetFace == 3 && kNetBehind == 4);
        indices_[k] = choices[polar ? SUPPLE_POLAR_NET_KIND(k) : SUPPLE_NET_KIND(k)];
    }
}

CubicIndices NetIndices::curve(uint32_t side) const {
    CubicIndices curve{};
    for (uint32_t k = 0; k < 4; ++k) {
        const uint32_t i[4] = {k, 3, 3 - k, 0}, j[4] = {0, k, 3, 3 - k};
        curve[k] = at(i[side], j[side]);
    }
    return curve;
}

CubicIndices NetIndices::inside(uint32_t side) const {
    CubicIndices curve{};
    for (uint32_t k = 0; k < 4; ++k) {
        const uint32_t i[4] = {k, 2, 3 - k, 1}, j[4] = {1, k, 2, 3 - k};
        curve[k] = at(i[side], j[side]);
    }
    return curve;
}

} // namespace supple::surface
