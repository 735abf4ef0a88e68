// Patterns of level of detail: where the samples of an edge, a row or a column lie at a real-valued level.
//
// A level L in [1, 63] is a number of segments. An odd integer gives L equal segments; between two odd integers, one
// pair of segments grows from nothing. A grid has an odd capacity R >= L; segments that L does not have are of zero
// width. The distinct parameters depend on L alone, not on R. This follows Moreton, "Watertight tessellation using
// forward differencing" (2001), and the fractional odd spacing of D3D11 and Vulkan. Segments are born in a fixed order,
// so that patterns are nested.
#pragma once

#include "shaders/shared/lod.h"

#include <array>
#include <cstdint>
#include <vector>

namespace supple::surface::lod {

/// The capacities of grids, in rising order.
inline constexpr std::array<uint32_t, shared::kCapacityCount> kCapacities{SUPPLE_LOD_CAPACITIES};

/// The words of all capacities, one capacity after the other. With h = (capacity - 1) / 2, a capacity has the words
/// n = 0..h. Bit j of word n is set if the j-th segment from the corner is among the first n that are born.
[[nodiscard]] std::vector<uint32_t> patternWords();

} // namespace supple::surface::lod
