// The modelled, rigged and painted creature as the library's plain data.
#pragma once

#include "clips.h"
#include "uv.h"
#include "weights.h"

#include "cage/character.h"

namespace supple::creature {

// All numbers on a fixed grid, so that the last bits of a maths library cannot show in the file.
cage::Character assemble(const Cage& model, const Skeleton& skeleton, const std::vector<Influences>& influences,
                         const std::vector<Vec3>& colors, const Atlas& atlas, const std::vector<Clip>& clips);

} // namespace supple::creature
