// Root motion: how far a clip carries the character, taken out of the pose so that the host can move the instance.
#pragma once

#include "cage/character.h"
#include "skinning/pose.h"

#include <cstdint>
#include <glm/glm.hpp>

namespace supple::skinning {

/// What of the root's movement counts as the character's; in model space, where +Y is up.
enum RootAxes : uint32_t {
    kRootGround = 1, ///< translation along x and z
    kRootHeight = 2, ///< translation along y
    kRootYaw = 4     ///< the turn about +Y
};

/// Whose movement is taken, and what of it. No axes: none.
struct RootSelection {
    uint32_t node = cage::kNone;
    uint32_t axes = 0;
};

/// A turn about +Y, then a translation.
struct RootMotion {
    glm::dvec3 translation{0.0};
    double yaw = 0.0; ///< radians
};
[[nodiscard]] RootMotion operator*(const RootMotion& a, const RootMotion& b); ///< b, then a
[[nodiscard]] RootMotion inverse(const RootMotion& motion);
[[nodiscard]] glm::dmat4 toMatrix(const RootMotion& motion);

/// A time that runs on, as a time in the clip and the number of whole loops before it.
struct LoopTime {
    double time = 0.0;  ///< 0 <= time < duration
    double loops = 0.0; ///< a whole number
};
[[nodiscard]] LoopTime loopTime(double time, double duration);

/// The node above most of the skin's joints among those that some clip moves or turns and above which nothing moves:
/// kNone where no clip does.
[[nodiscard]] uint32_t findRoot(const cage::Character& character);

/// Where a node is in model space at a time of the clip, and how it is turned.
struct RootPlace {
    glm::dvec3 position{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
};
[[nodiscard]] RootPlace rootPlaceAt(const cage::Character& character, const cage::Clip& clip, uint32_t node,
                                    double time);

/// Takes the movement since the clip's start out of `pose`, a sample of `clip`: the root stays where it starts. What
/// was taken, applied to the whole model, would put it back.
void removeRootMotion(const cage::Character& character, const cage::Clip& clip, const RootSelection& root, Pose& pose);

/// The movement from one time to another, in the frame the character has at the first: an instance placed by T moves to
/// T * motion. Looping, every loop begins where the last one ended; else times are clamped to the clip. The yaw is the
/// shorter way.
[[nodiscard]] RootMotion rootMotionBetween(const cage::Character& character, const cage::Clip& clip,
                                           const RootSelection& root, double from, double to, bool loop);

} // namespace supple::skinning
