// Where the surface vertices of an instance lie.
#pragma once

#include "surface/scheme.h"

#include <cstdint>
#include <vector>

namespace supple::surface {

/// The layout of an instance's surface vertices at a rate, and the strides between instances.
struct Evaluation {
    uint32_t rate = 8;
    uint32_t verticesPerInstance = 0;    ///< at least what layOut() returns
    std::vector<uint32_t> firstVertices; ///< per patch range: its first vertex in an instance; polygons: of all
    uint32_t firstEdgeVertex = 0;        ///< indexed mesh: the vertices of edges, then those of corners
    uint32_t firstCornerVertex = 0;

    /// Lays out the ranges of `tables` one after the other, beginning at `first`. Returns where they end.
    uint64_t layOut(const Tables& tables, uint64_t first = 0);
};

} // namespace supple::surface
