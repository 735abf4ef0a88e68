// Rotations as unit quaternions, in double.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace supple::skinning {

/// A whole turn, in radians.
inline constexpr double kTurn = 6.283185307179586;

/// Of unit length; a zero quaternion counts as no rotation.
[[nodiscard]] glm::dquat unit(const glm::dquat& q);

/// As (x, y, z, w).
[[nodiscard]] inline glm::vec4 floatsOf(const glm::dquat& q) {
    return glm::vec4(glm::dvec4(q.x, q.y, q.z, q.w));
}

/// Spherical, along the shorter way; straight where the arc is too short to divide by its sine. t may leave [0, 1].
[[nodiscard]] glm::dquat slerp(const glm::dquat& a, const glm::dquat& b, double t);

/// The rotation of `matrix`: its polar factor R in matrix = R * S with S symmetric, that is, the nearest rotation. A
/// mirroring matrix is -R * S: then all of a mirrored skeleton turns alike, whatever it is mirrored at. Where the
/// matrix is singular, one of the nearest rotations; of a zero matrix, none.
[[nodiscard]] glm::dquat nearestRotation(const glm::dmat3& matrix);

} // namespace supple::skinning
