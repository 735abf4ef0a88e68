// What acceleration structures need of a device. They are the host's; Supple only gives its buffers addresses and a
// usage.
#pragma once

#include "gpu/device.h"

#include <span>
#include <string>

namespace supple::gpu {

/// The usage that a buffer has besides its own if structures are built from it.
inline constexpr VkBufferUsageFlags kBuildInputUsage =
    VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR;

/// The names of the device extensions.
[[nodiscard]] std::span<const char* const> rayTracingExtensions();
/// The first of them, or the first feature, that `physicalDevice` lacks; or empty. The instance is fit.
[[nodiscard]] std::string missingForRayTracing(VkInstance instance, VkPhysicalDevice physicalDevice,
                                               PFN_vkGetInstanceProcAddr getInstanceProcAddr);
/// The first feature that a chain given to vkCreateDevice does not enable, or empty.
[[nodiscard]] std::string disabledForRayTracing(const void* chain);

} // namespace supple::gpu
