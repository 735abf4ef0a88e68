// Chess pieces as modellers make them: turned profiles of quads with creases that end, meet and turn inside the
// surface.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::test {

struct RookShape {
    uint32_t merlons = 3;
    uint32_t merlonColumns = 2;
    uint32_t gapColumns = 2;
    bool rings = false;   ///< the hard ring round the tower runs on below the merlons
    double support = 0.0; ///< how far below the battlements another ring of vertices lies; 0: none
    float sharpness = cage::kHardSharpness;
};
/// A tower with battlements: convex corners on the merlons, corners of three quarters of a turn at their feet, flat
/// ones with RookShape::rings. Rings round the foot and the neck are creased.
[[nodiscard]] cage::Cage rook(const RookShape& shape);

enum class BishopCut {
    groove, ///< a slanted groove whose lips end in the smooth head, in two darts on either side
    slit    ///< the lips meet in a point on either side, and the bottom of the cut is a crease as well
};
/// A bishop with a slanted cut over `span` of `columns` columns.
[[nodiscard]] cage::Cage bishop(uint32_t columns, uint32_t span, BishopCut cut, float sharpness);

struct ChessPiece {
    std::string name;
    uint32_t columns = 0;
    cage::Cage cage;
};
/// Rooks and bishops with hard and with semi-sharp creases.
[[nodiscard]] const std::vector<ChessPiece>& chessPieces();

} // namespace supple::test
