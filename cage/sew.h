// Sews the parts of a character together where their boundaries coincide.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <span>

namespace supple::cage {

/// Makes vertices of different parts one where boundary edges coincide in position, skin and morph targets, so that the
/// surface goes on smoothly from part to part. The parts need not be repaired: faces count as their repair turns them
/// (soundFaces()), and what faces of other parts fill is no damage. The vertex of the earliest part stays. Edges of
/// one part are not sewn to each other: the part's own reader has decided about them. Nor are faces that would lie back
/// to back.
///
/// `gridSteps`: per part the step of the grid that its positions were rounded to, or 0. Positions of two parts coincide
/// if rounding alone keeps them apart; a warning says how many did so. Returns how many vertices were merged away.
uint32_t sewParts(Character& character, std::span<const float> gridSteps = {});

} // namespace supple::cage
