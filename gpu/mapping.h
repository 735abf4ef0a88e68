// How compute work is laid on a device: the one place where device properties become specialization constants.
#pragma once

#include <cstdint>
#include <vulkan/vulkan_core.h>

namespace supple::gpu {

struct Mapping {
    bool wide = false;          ///< many lanes a patch and storage-buffer loads, else one lane a patch and texel loads
    bool lacksTexels = false;   ///< wide for this reason alone
    bool exactDivision = false; ///< the device rounds float division correctly, so k / rate needs no table
    uint32_t localSize = 32;
    /// Lanes that keep all of the device busy: a kernel with so many need not divide its work.
    uint32_t lanesToFill = 64;
    /// Surfaces at a rate keep records of fans instead of coefficients, where their scheme can (surface/recipe.h).
    bool fanRecords = false;
    /// Groups share dispatches (gpu/tasks.h). Wide alone.
    bool sharesDispatches = false;
    /// The driver writes timestamps late and reads them only from an idle device: gpu/timers.h.
    bool lazyTimestamps = false;
};

enum class MappingChoice { automatic, narrow, wide };

/// Narrow on CPU devices that can read `texels` enough of a buffer (maxTexelBufferElements; 0: none at all), wide on
/// everything else, unless the caller chooses.
[[nodiscard]] Mapping chooseMapping(VkPhysicalDeviceType type, VkDriverId driver, uint32_t texels,
                                    MappingChoice choice);

} // namespace supple::gpu
