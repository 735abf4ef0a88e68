// Hard edges of a file's normals as creases.
#pragma once

#include "cage/character.h"

#include <cstdint>

namespace supple::cage {

/// Makes every edge whose normals are split (hasSplitNormals() of cage/corner_normals.h) infinitely sharp, so that
/// smooth schemes keep it. Returns how many edges that are. A cage that is no manifold stays as it is. O(corners log
/// corners).
uint32_t creaseSplitNormals(Cage& cage);

} // namespace supple::cage
