// A piece of a cage: some of its faces as a cage of their own.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::cage {

struct CagePiece {
    Cage cage;                      ///< without sourceVertices
    std::vector<uint32_t> faces;    ///< one per face: the whole cage's face
    std::vector<uint32_t> vertices; ///< one per vertex: the whole cage's vertex, rising
};

/// Takes faces (rising) with the vertices that they have and all that belongs to them, such as creases. Edges that the
/// piece shares with other faces become its boundary. O(corners log corners).
[[nodiscard]] CagePiece takeFaces(const Cage& cage, std::span<const uint32_t> faces);

} // namespace supple::cage
