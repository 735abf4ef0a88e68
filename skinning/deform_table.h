// What the deform pass reads of a character: rest positions, displacements and influences.
#pragma once

#include "cage/character.h"
#include "skinning/skinning_mode.h"

#include <cstdint>
#include <vector>

namespace supple::skinning {

/// In the layout of shaders/shared/deform.h.
struct DeformTable {
    std::vector<uint32_t> words;  ///< four an element
    uint32_t firstInfluences = 0; ///< element where the first influences are listed; 0: no target moves a vertex
    uint32_t firstCenter = 0;     ///< element where the centers are listed; 0: there are none
};
[[nodiscard]] DeformTable buildDeformTable(const cage::Character& character, const Skinning& skinning);

} // namespace supple::skinning
