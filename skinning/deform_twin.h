// The deform pass of one instance on the CPU, in the device's own arithmetic: the same source (shaders/deform/skin.h),
// so the same bits.
#pragma once

#include "skinning/deform_kernels.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace supple::skinning {

/// `pose`: an instance's elements. Fills one (x, y, z, side) a cage vertex.
void deformLikeTheDevice(const DeformTable& table, const PoseLayout& layout, std::span<const glm::vec4> pose,
                         std::span<glm::vec4> cage);

} // namespace supple::skinning
