// Sews the parts of a character together where their boundaries coincide.
#pragma once

#include "cage/character.h"

#include <cstdint>

namespace supple::cage {

/// Makes vertices of different parts one where boundary edges coincide in position, skin and morph targets, so that the
/// surface goes on smoothly from part to part. The vertex of the earliest part stays. Vertices of one part are never
/// merged: the part's own reader has decided about them. Returns how many vertices were merged away.
uint32_t sewParts(Character& character);

} // namespace supple::cage
