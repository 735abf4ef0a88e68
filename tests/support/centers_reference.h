// Centers of rotation on the CPU in double, as the paper writes them: an account of its own, against which those of the
// library and its deform pass are tested.
#pragma once

#include "cage/character.h"
#include "skinning/centers.h"
#include "skinning/pose.h"

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace supple::test {

/// Le and Hodgins 2016, formula (1), triangle by triangle: fans of the faces, cut `cuts` times at the middles of their
/// edges. Nothing for a vertex without a pair of joints.
[[nodiscard]] std::vector<std::optional<glm::dvec3>> centersOneByOne(const cage::Character& character, int cuts);

/// The library's, for skinAboutCenters().
[[nodiscard]] std::vector<std::optional<glm::dvec3>> centersOf(const skinning::Centers& centers);

/// Joint matrices are split into their polar factors. The center goes where linear skinning takes it; the rotations'
/// quaternions are blended on the side of the heaviest joint's, and turn the way from the center to the vertex, which
/// the blended stretches have changed before. `transform` moves the result.
[[nodiscard]] std::vector<glm::dvec3> skinAboutCenters(std::span<const glm::dvec3> positions,
                                                       std::span<const std::optional<glm::dvec3>> centers,
                                                       const cage::SkinWeights& weights,
                                                       std::span<const skinning::Affine> palette,
                                                       const glm::dmat4& transform = glm::dmat4(1.0));

} // namespace supple::test
