// Sews the parts of a character together where their boundaries coincide.
#pragma once

#include "cage/character.h"

#include <cstdint>

namespace supple::cage {

/// Makes vertices of different parts one where boundary edges coincide in position, skin and morph targets, so that the
/// surface goes on smoothly from part to part. The parts need not be repaired: faces count as their repair turns them
/// (soundFaces()), and what faces of other parts fill is no damage. The vertex of the earliest part stays. Edges of
/// one part are not sewn to each other: the part's own reader has decided about them. Nor are faces that would lie back
/// to back. Returns how many vertices were merged away.
uint32_t sewParts(Character& character);

} // namespace supple::cage
