// SuppleSkinning in the words of skinning/.
#pragma once

#include "skinning/skinning_mode.h"
#include "supple/supple.h"

namespace supple::runtime {

static_assert(SUPPLE_SKINNING_LINEAR == static_cast<int>(skinning::SkinningMode::linear) &&
              SUPPLE_SKINNING_DUAL_QUATERNION == static_cast<int>(skinning::SkinningMode::dualQuaternion) &&
              SUPPLE_SKINNING_CENTERS_OF_ROTATION == static_cast<int>(skinning::SkinningMode::centersOfRotation) &&
              SUPPLE_SKINNING_DELTA_MUSH == static_cast<int>(skinning::SkinningMode::deltaMush) &&
              SUPPLE_SKINNING_DELTA_MUSH_LIGHT == static_cast<int>(skinning::SkinningMode::deltaMushLight) &&
              SUPPLE_SKINNING_FROM_FILE == skinning::kSkinningModes);

/// FROM_FILE: what the first part says that says something.
[[nodiscard]] inline skinning::SkinningMode skinningOf(const cage::Character& character, SuppleSkinning wanted) {
    if (wanted != SUPPLE_SKINNING_FROM_FILE) {
        return static_cast<skinning::SkinningMode>(wanted);
    }
    for (const cage::Part& part : character.parts) {
        if (part.skinning) {
            return *part.skinning;
        }
    }
    return skinning::SkinningMode::linear;
}

} // namespace supple::runtime
