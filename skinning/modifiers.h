// Modifiers: what an instance's host changes of a pose behind the clips. Their formulas are shaders/pose/modify.h; here
// they are put into the words that these read, and what nobody names is found in the skeleton.
#pragma once

#include "cage/character.h"
#include "shaders/shared/pose.h"
#include "skinning/clip_table.h"
#include "skinning/layers.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>

namespace supple::skinning {

struct Modifier {
    uint32_t kind = shared::kModifierSet;
    uint32_t flags = 0;                              ///< shared::kModifierWorld, ...
    std::array<uint32_t, shared::kMaxChain> chain{}; ///< nodes of the skeleton, from the top down to the joint
    uint32_t chainLength = 1;
    float weight = 1.0f;
    float fadeWeight = 0.0f;
    double fadeStart = 0.0;
    float fadeDuration = 0.0f; ///< 0: the weight stands
    float share = 0.0f;        ///< to aim: what joints above the last one take of what is still missing
    /// To aim, and of a foot: radians that a joint turns at most; 0: any. To lower: how far.
    float limit = 0.0f;
    glm::vec3 target{0.0f}, pole{0.0f};
    float poleWeight = 0.0f, soft = 0.97f;
    glm::vec4 rotation{0.0f, 0.0f, 0.0f, 1.0f}; ///< x, y, z, w, of unit length
    /// To aim: forward, in the joint's frame. Of two bones, and of a foot: the hinge, in the middle joint's frame.
    glm::vec3 axis{0.0f, 0.0f, 1.0f};
    glm::vec3 eye{0.0f}; ///< to aim: in the joint's frame
};

/// The joint and those above it, as many as `length`, in a modifier's chain; nothing if the skeleton has fewer above
/// it, or if one has a fixed matrix, which nothing turns.
[[nodiscard]] std::optional<Modifier> chainOf(const cage::Character& character, std::span<const uint32_t> jointParents,
                                              uint32_t joint, uint32_t length);
/// The end of a limb, its middle and its root, in a modifier's chain. A bone that is cut into several joints counts
/// from the first of them on (Rig::boneStarts).
[[nodiscard]] std::optional<Modifier> limbOf(const cage::Character& character, const Rig& rig, uint32_t joint);

/// Model space's +Z, in the frame that a joint has in the rest pose: where it looks if nobody says.
[[nodiscard]] glm::vec3 restForward(const cage::Character& character, uint32_t node);
/// The axis about which the middle of a limb bends in the rest pose, in its frame. Of a straight limb, the one that
/// takes an upright limb's middle to +Z and a level one's to -Z, as knees and elbows do.
[[nodiscard]] glm::vec3 restHinge(const cage::Character& character, const Modifier& limb);

/// kModifierElements elements of four words.
void writeModifier(const ClipTable& table, const Modifier& modifier, std::span<uint32_t> words);
/// Puts another rotation, and a weight that stands.
void writeModifierTurn(const glm::vec4& rotation, float weight, std::span<uint32_t> words);
/// Puts another target, and pole of two bones.
void writeModifierPoints(const glm::vec3& target, const glm::vec3& pole, std::span<uint32_t> words);
[[nodiscard]] uint32_t modifierKind(std::span<const uint32_t> words);
[[nodiscard]] uint32_t modifierFlags(std::span<const uint32_t> words);
/// How far it lowers a joint at most; 0 if that is not what it does.
[[nodiscard]] float loweredBy(std::span<const uint32_t> words);
/// The places of the chain's nodes in the clip table, from the top down. They lie in `room`.
using ChainPlaces = std::array<uint32_t, shared::kMaxChain>;
[[nodiscard]] std::span<uint32_t> modifierPlaces(std::span<const uint32_t> words, ChainPlaces& room);
void writeModifierPlaces(std::span<const uint32_t> places, std::span<uint32_t> words);

} // namespace supple::skinning
