// Which corners of a cage are shaded as one: what hard edges cut apart.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <vector>

namespace supple::cage {

/// Per corner: the smallest corner of its smooth group. Two corners of a vertex are in one group if a chain of faces
/// leads from one to the other, across edges that are smooth there. If the cage has normals (Cage::cornerNormals), an
/// edge is smooth where the normals on both sides agree to a degree; a corner without a normal is alone. Otherwise an
/// edge is smooth unless it is infinitely sharp. Takes any cage, manifold or not. O(corners log corners).
[[nodiscard]] std::vector<uint32_t> smoothGroups(const Cage& cage);

} // namespace supple::cage
