// What the ways of skinning need: a row each.
#pragma once

#include "cage/character.h"
#include "shaders/shared/deform.h"

#include <cstddef>

namespace supple::skinning {

using cage::SkinningMode;

struct SkinningRow {
    const char* kernels[2]; ///< names of the deform pass, without and with morph targets
    bool rotations;         ///< poses have the joints' rotations, and the instance's transform apart
    bool centers;           ///< the deform table has centers of rotation (skinning/centers.h)
};

[[nodiscard]] inline const SkinningRow& skinningRow(SkinningMode mode) {
    static constexpr SkinningRow kRows[] = {
        {{"supple deform", "supple deform, morphs"}, false, false},
        {{"supple deform, dual quaternions", "supple deform, dual quaternions, morphs"}, true, false},
        {{"supple deform, centers of rotation", "supple deform, centers of rotation, morphs"}, true, true},
    };
    return kRows[static_cast<size_t>(mode)];
}
inline constexpr size_t kSkinningModes = 3;

static_assert(static_cast<uint32_t>(SkinningMode::linear) == shared::kLinearSkinning &&
              static_cast<uint32_t>(SkinningMode::dualQuaternion) == shared::kDualQuaternionSkinning &&
              static_cast<uint32_t>(SkinningMode::centersOfRotation) == shared::kCenterSkinning);

} // namespace supple::skinning
