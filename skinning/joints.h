// Joints in model space: where a pose puts them, and where they are when nothing plays.
#pragma once

#include "cage/character.h"
#include "skinning/pose.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::skinning {

/// joints[j] = global(skin.joints[j]): a joint's matrix without the inverse bind.
void jointTransforms(const cage::Skin& skin, std::span<const glm::mat4> globals, std::span<glm::mat4> joints);

/// What no clip changes, one of each per joint.
struct JointFrames {
    std::vector<glm::mat4> rest; ///< the file's node transforms
    std::vector<glm::mat4> bind; ///< the inverse of the inverse bind matrix; where it has none, the rest transform
    std::vector<uint8_t> bindIsSingular; ///< 1: the inverse bind matrix has no inverse in finite floats
};
[[nodiscard]] JointFrames jointFrames(const cage::Character& character);

/// place * joint; the joint's own bits where place is the identity.
[[nodiscard]] glm::mat4 placedJoint(const glm::dmat4& place, const glm::mat4& joint);

} // namespace supple::skinning
