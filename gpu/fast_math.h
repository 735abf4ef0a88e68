// Drivers that hand kernels to a compiler with fast math, and what keeps them from it. SPIR-V says by NoContraction
// which operations must be rounded as they are written. Metal's fast math may move operations about all the same, and
// then two patches that have an edge in common no longer have the same bits there.
#pragma once

#include "gpu/functions.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::gpu {

/// Whether the driver compiles with fast math unless a kernel has the execution mode SignedZeroInfNanPreserve, and
/// knows that mode: MoltenVK. Others keep to NoContraction, and would compute slower with it. The device has
/// Vulkan 1.2.
[[nodiscard]] bool hasFastMath(const Functions& vk, VkPhysicalDevice physicalDevice);

/// The kernel with that execution mode for 32-bit floats. It has one entry point.
[[nodiscard]] std::vector<uint32_t> withoutFastMath(std::span<const uint32_t> spirv);

} // namespace supple::gpu
