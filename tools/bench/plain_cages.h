// Cages that the benchmark makes on the spot, beside those of tools/common.
#pragma once

#include "cage/character.h"

#include <cstdint>

namespace supple::bench {

/// around x across quads, all of valence 4.
[[nodiscard]] cage::Cage quadTorus(uint32_t around, uint32_t across);
/// Every quad cut along a diagonal.
[[nodiscard]] cage::Cage triangulated(const cage::Cage& quads);
/// Twelve pentagons.
[[nodiscard]] cage::Cage dodecahedron();

} // namespace supple::bench
