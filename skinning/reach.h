// How far a character's cage can reach, whatever its clips do: what is known of a cage before it is posed.
#pragma once

#include "cage/character.h"
#include "skinning/box.h"
#include "skinning/pose.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::skinning {

/// What of a character bounds its cages. Layers that blend (LayerMode::blend) mix translations, scales and morph
/// weights linearly and keep rotations of unit length. So they cannot take a node farther from the node above it than
/// the longest translation does that a clip or the rest pose has, times the largest scales above. Vertices cannot be
/// farther from the joints that they follow than in the bind pose, but for scales and morph targets.
///
/// An anchor is the first node on the way down that some clip moves, turns or scales. Above it nothing moves, so all of
/// its places lie in one box; what hangs on it lies within a radius of that box.
struct Reach {
    Box blended; ///< holds the cage in every pose that layers that blend can make of the clips, skinned linearly
    /// By how much of the size of a box that holds linearly skinned cages those that dual quaternions skin can leave
    /// it: whatever the rotations are.
    double dualQuaternions = 0.0;
    /// By node: 1 if it is an anchor or hangs on one. Whatever turns it, the cage stays within `blended`.
    std::vector<uint8_t> anchored;
    uint32_t anchor = cage::kNone; ///< the only one, if there is one and all joints hang on it
    glm::dvec3 anchorPath{0.0};    ///< size of the box of its places
    std::vector<double> targets;   ///< by morph target: what a weight of 1 adds to `blended` at most
    /// By joint, in the bind pose: the box of the vertices that follow it; empty (low > high) if none does.
    std::vector<Box> joints;
    std::vector<double> deltas; ///< by morph target: the longest displacement in the bind pose
    double morphed = 0.0;       ///< how far targets take a vertex in those poses, in the bind pose, at most
    std::vector<double> sizes;  ///< by joint: the norm of its matrix with its inverse bind in those poses, at most
};
[[nodiscard]] Reach reachOf(const cage::Character& character);

/// Holds the cages that dual quaternions skin, given a box that holds those that are skinned linearly, joint by joint.
[[nodiscard]] Box dualQuaternionBounds(const Reach& reach, const Box& linear);
/// Holds the cage in the bind pose with morph weights, one per target; none: without morphing.
[[nodiscard]] Box bindBounds(const Reach& reach, std::span<const float> morphWeights);
/// Holds the cage that a palette makes, linearly skinned. `morphWeights`: one per target.
[[nodiscard]] Box paletteBounds(const Reach& reach, std::span<const Affine> palette,
                                std::span<const float> morphWeights);
/// The sum of weights by what each adds: Reach::targets or Reach::deltas.
[[nodiscard]] double reachedBy(std::span<const float> morphWeights, std::span<const double> targets);

} // namespace supple::skinning
