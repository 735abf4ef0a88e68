// Hard edges as creases: those of a file's normals, and those whose faces meet at an angle.
#pragma once

#include "cage/character.h"

#include <cstdint>

namespace supple::cage {

/// Makes every edge whose normals are split (hasSplitNormals() of cage/corner_normals.h) infinitely sharp, so that
/// smooth schemes keep it. Returns how many edges that are. A cage that is no manifold stays as it is. O(corners log
/// corners).
uint32_t creaseSplitNormals(Cage& cage);

/// Makes every edge infinitely sharp at which the mean planes of its two faces meet at more than `degrees`. Returns how
/// many edges that are. A cage that is no manifold stays as it is. O(corners log corners).
uint32_t creaseAngles(Cage& cage, double degrees);

} // namespace supple::cage
