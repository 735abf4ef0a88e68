// Device memory as a host gives it: each piece by a vkAllocateMemory of its own, and counted.
#pragma once

#include "host/device.h"

#include <cstdint>
#include <supple/supple.h>

namespace supple::bench {

/// Must outlive the contexts that take memory from it.
class CountedMemory {
public:
    explicit CountedMemory(const host::Device& device);
    CountedMemory(const CountedMemory&) = delete;
    CountedMemory& operator=(const CountedMemory&) = delete;

    [[nodiscard]] const SuppleMemoryCallbacks& callbacks() const { return callbacks_; }
    /// Pieces that were allocated and not freed.
    [[nodiscard]] uint32_t held() const { return allocations_ - frees_; }

private:
    static VkResult allocate(const VkMemoryRequirements* requirements, VkMemoryPropertyFlags required,
                             VkMemoryPropertyFlags preferred, const char* name, SuppleMemory* out, void* user);
    static void free(const SuppleMemory* memory, void* user);

    VkDevice device_;
    VkPhysicalDeviceMemoryProperties properties_{};
    SuppleMemoryCallbacks callbacks_{};
    uint32_t allocations_ = 0, frees_ = 0;
};

} // namespace supple::bench
