// Writes the character as one glTF 2.0 binary.
#pragma once

#include "clips.h"
#include "uv.h"
#include "weights.h"

#include <string>
#include <vector>

namespace supple::creature {

bool writeGlb(const std::string& path, const Cage& cage, const Skeleton& skeleton,
              const std::vector<Influences>& influences, const std::vector<Vec3>& colours, const Atlas& atlas,
              const std::vector<Clip>& clips);

} // namespace supple::creature
