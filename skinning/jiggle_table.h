// What jiggles of a character, in the layout that the device reads (shaders/shared/soft.h).
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace supple::skinning {

/// exp(h [[0, 1], [-k, -c]]) of a step h of the grid, row after row: what a spring does to offset and speed in a step.
/// Each entry is rounded towards 0, so that an undamped spring never gains energy.
[[nodiscard]] glm::vec4 jiggleSpring(const cage::Jiggle& jiggle);

struct JiggleTable {
    std::vector<uint32_t> words;
    uint32_t vertexCount = 0; ///< that jiggle; 0: there are no words
    uint32_t mostWork = 0;    ///< of a vertex: as deformWork()
};
[[nodiscard]] JiggleTable buildJiggleTable(const cage::Character& character);

} // namespace supple::skinning
