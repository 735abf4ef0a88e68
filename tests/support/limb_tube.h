// A limb whose answers are known.
#pragma once

#include "cage/character.h"

#include <glm/glm.hpp>
#include <span>

namespace supple::test {

/// Radius 1, 16 long, 33 rings of 12 vertices along +z, two joints; weights go over in a smooth step within 2 of the
/// second joint, which is at 0. Hard: at once.
[[nodiscard]] cage::Character limbTube(bool hard = false);
/// With its ends closed.
[[nodiscard]] double limbTubeVolume(std::span<const glm::dvec3> points);

} // namespace supple::test
