// What the limit at a vertex is made of, by the sharpness of its spokes: weights of the points round it on level 1.
// Sharp steps are in the weights, however many there are. Weights are in double. Formulas: docs/catmull_clark.md.
#pragma once

#include "surface/subdivision/masks.h"

namespace supple::surface::chains {

/// A vertex's fan, and the sharpness on level 1.
struct Arrangement {
    subdivision::Fan fan;
    std::vector<float> spokes;
    float vertex = 0.0f;

    [[nodiscard]] bool operator<(const Arrangement& other) const {
        return std::tie(fan, spokes, vertex) < std::tie(other.fan, other.spokes, other.vertex);
    }
};

/// Sectors between two sharp spokes, or all of them, have a normal: the sum of the cross products of tangents that
/// follow each other. There are two tangents, but for a corner of several sectors, which has one along each spoke.
struct LimitRun {
    uint32_t firstSector = 0, sectors = 0;
    std::vector<subdivision::CentreMask> tangents; ///< their common length has no meaning
};
struct Limit {
    subdivision::CentreMask position;
    std::vector<LimitRun> runs; ///< every sector is in one of them
};
/// The masks act on the points of ring 1 on level 1, as differences to the centre.
[[nodiscard]] Limit limitOf(const Arrangement& arrangement);

} // namespace supple::surface::chains
