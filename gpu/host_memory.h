// Device memory as it is allocated: from the host's allocator, or from the device.
#pragma once

#include "base/result.h"

#include <functional>
#include <vulkan/vulkan_core.h>

namespace supple::gpu {

struct Device;

enum class MemoryKind {
    deviceLocal, ///< never mapped
    upload,      ///< host visible and coherent, mapped for its whole life
    readback,    ///< the same, for the host to read: cached if it can be
};

/// A piece of device memory that the host allocated, or the device for Supple alone.
struct HostMemory {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    void* mapped = nullptr;
    void* allocation = nullptr; ///< the host's
};
/// The host's own allocator of device memory, in place of vkAllocateMemory; both or neither.
struct MemorySource {
    std::function<VkResult(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags required,
                           VkMemoryPropertyFlags preferred, const char* name, HostMemory& out)>
        allocate;
    std::function<void(const HostMemory&)> free;
};

/// `what` begins messages.
[[nodiscard]] Result<HostMemory> allocateHostMemory(const Device& device, const VkMemoryRequirements& requirements,
                                                    MemoryKind kind, const char* name, const std::string& what);
/// The way it came.
void freeHostMemory(const Device& device, const HostMemory& memory);

} // namespace supple::gpu
