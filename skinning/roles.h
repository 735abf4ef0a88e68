// What the joints of a biped are, whatever a file calls them: hips, legs, arms, neck and head.
#pragma once

#include "cage/character.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace supple::skinning {

/// Parts of a body. Those of limbs are there on both sides.
enum class BodyPart : uint8_t { hips, neck, head, thigh, shin, foot, toes, clavicle, upperArm, lowerArm, hand };
inline constexpr size_t kParts = 11;
inline constexpr size_t kMiddleParts = 3; ///< the first so many have no side

/// A part and its side, as a place in Roles: parts of the middle, then those of the left, then those of the right.
using Role = uint8_t;
inline constexpr size_t kSideParts = kParts - kMiddleParts;
inline constexpr size_t kRoles = kMiddleParts + 2 * kSideParts;
inline constexpr size_t kLeft = 0, kRight = 1;
[[nodiscard]] constexpr Role roleOf(BodyPart part, size_t side = kLeft) {
    const auto p = static_cast<size_t>(part);
    return static_cast<Role>(p < kMiddleParts ? p : p + side * kSideParts);
}

/// By role: the node that has it, or kNone.
using Roles = std::array<uint32_t, kRoles>;

/// "hips", "thigh.l"
[[nodiscard]] std::string nameOfRole(Role role);
[[nodiscard]] std::optional<Role> roleNamed(std::string_view name);

/// Finds who has which role, by names and by structure. Of a name counts what stands behind the last ':' or '|'; the
/// side is a word l, r, left or right, or a part of the name; what is left must be one of a part's usual names (thigh,
/// upperleg, upleg; shin, calf, lowerleg; ...), but for digits behind it and prefixes such as Bip01, DEF or J_Bip.
///
/// A shin is below its thigh, a foot below its shin, and so on; of several nodes of one name, the topmost for which
/// there is a whole limb. The hips are the lowest node above both thighs, arms and the head, unless that is much lower
/// than what is above both thighs, which then are the hips. `given` has the roles that a user knows better: they go
/// first.
[[nodiscard]] Roles findRoles(const cage::Skeleton& skeleton, const Roles& given);

/// Hips and two legs: less than that cannot be retargeted.
[[nodiscard]] bool hasLegs(const Roles& roles);
/// Why it has not, or nothing: "no left thigh, shin and foot below each other".
[[nodiscard]] std::string whatIsMissing(const Roles& roles);

} // namespace supple::skinning
