// Modifiers of a pose from command lines: a joint, and where it goes or how it is turned.
#pragma once

#include "base/result.h"
#include "cage/character.h"

#include <array>
#include <string>
#include <supple/supple.h>
#include <vector>

namespace supple::host {

struct ModifierSetting {
    SuppleModifierKind kind = SUPPLE_MODIFIER_SET;
    std::string joint; ///< name, else number
    std::array<double, 6> numbers{};
};

/// "head=0.5,1.2,3": a point of model space. The error says what is wrong in a few words.
[[nodiscard]] Result<ModifierSetting> parseAim(const std::string& text);
[[nodiscard]] Result<ModifierSetting> parseTwoBone(const std::string& text);
/// "foot=x,y,z,nx,ny,nz": a point of the ground and its normal, both in model space.
[[nodiscard]] Result<ModifierSetting> parsePlant(const std::string& text);
/// "hips=most": how far a joint may go down.
[[nodiscard]] Result<ModifierSetting> parseLower(const std::string& text);
/// "head=x,y,z,w": a rotation in model space.
[[nodiscard]] Result<ModifierSetting> parseSet(const std::string& text);

/// The rotations that are set, then aims, then limbs, then what is lowered, then feet, each with the weight; what
/// suppleSetModifiers takes. The error names a joint that is not there.
[[nodiscard]] Result<std::vector<SuppleModifier>>
modifiersOf(const cage::Character& character, const std::vector<ModifierSetting>& settings, float weight);

} // namespace supple::host
