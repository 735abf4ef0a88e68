// The levels of a chain of smooth texture coordinates, in double. Private to chains/.
#pragma once

#include "surface/subdivision/masks.h"

#include <glm/glm.hpp>
#include <vector>

namespace supple::surface::chains {

/// Points up to radius 3, of those up to radius 2 of the level before. `spokes` and `vertex`: the sharpness there.
[[nodiscard]] std::vector<glm::dvec2> nextChainLevel(const subdivision::Fan& fan, const std::vector<glm::dvec2>& before,
                                                     const std::vector<float>& spokes, float vertex);

} // namespace supple::surface::chains
