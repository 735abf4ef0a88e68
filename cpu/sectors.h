// Which sector of a P_m patch a place lies in.
#pragma once

#include "cpu/place.h"

namespace supple::cpu {

/// The weights of the sector's first corner, of its second corner and of the middle.
struct SectorPlace {
    glm::dvec3 weights{0.0};
    Place place; ///< with derivatives in the weights of the second corner and of the middle
};

/// `place`: as PatchSet::evaluate() has it. Of two sectors that meet there the choice is that of the device.
[[nodiscard]] SectorPlace sectorPlace(uint32_t sides, const Place& place);

} // namespace supple::cpu
