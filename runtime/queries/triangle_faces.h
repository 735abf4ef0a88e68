// Which faces of the cage the triangles of a group are of, as queries look it up (shaders/shared/queries.h).
#pragma once

#include "runtime/queries/query_pieces.h"
#include "runtime/surfaces.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::runtime {

/// Surfaces that draw no grids or meshes have no triangles.
[[nodiscard]] std::vector<uint32_t> triangleFaces(const Surfaces& surfaces, std::span<const FacePieces> pieces);
/// The rate of a group with grids or meshes: segments along an edge of the cage. If the cages of all surfaces take
/// steps, those of the patches tell no more than a multiple of two that gives the same patches.
[[nodiscard]] uint32_t rateOf(const Surfaces& surfaces);

} // namespace supple::runtime
