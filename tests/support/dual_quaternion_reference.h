// Dual quaternion skinning on the CPU in double, as its papers write it: an account of its own, against which the
// deform pass and its preparation are tested.
#pragma once

#include "cage/character.h"
#include "skinning/pose.h"

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::test {

/// Kavan et al. 2008 over joint matrices: each is split into its polar factors, rotation and stretch; the rotation and
/// the translation that is left when the stretch keeps the vertex in its place (Blender, issues 32022, 43188, 100373)
/// become a unit dual quaternion; these are blended linearly, on the side of the heaviest joint, and normalised.
/// `transform` moves the result.
[[nodiscard]] std::vector<glm::dvec3> skinWithDualQuaternions(std::span<const glm::dvec3> positions,
                                                              const cage::SkinWeights& weights,
                                                              std::span<const skinning::Affine> palette,
                                                              const glm::dmat4& transform = glm::dmat4(1.0));

} // namespace supple::test
