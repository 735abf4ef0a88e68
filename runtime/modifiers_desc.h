// SuppleModifiersDesc: checked, and in the words of skinning/.
#pragma once

#include "base/result.h"
#include "runtime/asset.h"
#include "runtime/instance_modifiers.h"
#include "supple/supple.h"

#include <array>
#include <cstdint>

namespace supple::runtime {

using PlacedModifiers = std::array<PlacedModifier, SUPPLE_MAX_MODIFIERS>;
/// Fills the first `desc.modifierCount` of `modifiers`, or names the first rule of supple_playback.h that is broken.
[[nodiscard]] Status readModifiers(const Asset& asset, const SuppleModifiersDesc& desc, PlacedModifiers& modifiers);

/// What the modifier with these words is to do from now on, or the rule that is broken.
[[nodiscard]] Result<ModifierGoal> readModifierTarget(std::span<const uint32_t> words,
                                                      const SuppleModifierTarget& target);

} // namespace supple::runtime
