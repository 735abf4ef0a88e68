// What the ways of skinning need: a row each.
#pragma once

#include "cage/character.h"
#include "shaders/shared/deform.h"

#include <cstddef>

namespace supple::skinning {

struct Centers;
struct DeltaMush;
using cage::SkinningMode;

/// What deform tables have beside influences.
enum class SkinExtra : uint8_t { none, centers, mush };
/// Ways of skinning that read the same deform table.
enum class SkinTableKind : uint8_t { plain, centers, mush, lightMush };
inline constexpr size_t kSkinTables = 4;

struct SkinningRow {
    const char* kernels[2]; ///< names of the deform pass, without and with morph targets
    bool rotations;         ///< poses have the joints' rotations, and the instance's transform apart
    SkinExtra extra;
    SkinTableKind table;
};

[[nodiscard]] inline const SkinningRow& skinningRow(SkinningMode mode) {
    static constexpr SkinningRow kRows[] = {
        {{"supple deform", "supple deform, morphs"}, false, SkinExtra::none, SkinTableKind::plain},
        {{"supple deform, dual quaternions", "supple deform, dual quaternions, morphs"},
         true,
         SkinExtra::none,
         SkinTableKind::plain},
        {{"supple deform, centers of rotation", "supple deform, centers of rotation, morphs"},
         true,
         SkinExtra::centers,
         SkinTableKind::centers},
        {{"supple deform, delta mush", "supple deform, delta mush, morphs"},
         true,
         SkinExtra::mush,
         SkinTableKind::mush},
        {{"supple deform, light delta mush", "supple deform, light delta mush, morphs"},
         true,
         SkinExtra::mush,
         SkinTableKind::lightMush},
    };
    return kRows[static_cast<size_t>(mode)];
}
inline constexpr size_t kSkinningModes = 5;
/// Its kernels have code of their own.
[[nodiscard]] inline bool isMush(SkinningMode mode) {
    return skinningRow(mode).extra == SkinExtra::mush;
}

static_assert(static_cast<uint32_t>(SkinningMode::linear) == shared::kLinearSkinning &&
              static_cast<uint32_t>(SkinningMode::dualQuaternion) == shared::kDualQuaternionSkinning &&
              static_cast<uint32_t>(SkinningMode::centersOfRotation) == shared::kCenterSkinning &&
              static_cast<uint32_t>(SkinningMode::deltaMush) == shared::kMushSkinning &&
              static_cast<uint32_t>(SkinningMode::deltaMushLight) == shared::kLightMushSkinning);

/// A way of skinning, and what it needs of a character: the others may be null. Whoever made them keeps them.
struct Skinning {
    SkinningMode mode = SkinningMode::linear;
    const Centers* centers = nullptr;
    const DeltaMush* mush = nullptr;
};

} // namespace supple::skinning
