// Cloths made by hand: the cape and the ball of the literature's tests, each on a joint.
#pragma once

#include "cage/character.h"

#include <cstdint>

namespace supple::test {

/// A sheet of quads that hangs from its first row: 0.6 wide, 0.9 long, 12 x 16 vertices, behind a capsule of radius
/// 0.11. `last`: how far its last row is moved towards the front.
[[nodiscard]] cage::Character cape(float last = 0.0f);
/// Vertex of column i, 0 to 11, in row j, 0 to 15.
constexpr uint32_t capeVertex(uint32_t i, uint32_t j) {
    return 12 * j + i;
}
/// A ball of triangles of radius 0.12 that hangs on its upper cap, its volume kept: 114 vertices, one of which is no
/// part of it.
[[nodiscard]] cage::Character ball();

} // namespace supple::test
