// The descriptor sets of the deform pass, one a window of instances.
#pragma once

#include "gpu/bound_sets.h"
#include "gpu/memory.h"
#include "runtime/instance_windows.h"

namespace supple::runtime {

class DeformSets {
public:
    /// A buffer that has `stride` elements of 16 bytes for every slot.
    struct InstanceArray {
        VkBuffer buffer = VK_NULL_HANDLE;
        uint32_t stride = 0;
    };
    struct Desc {
        const gpu::Device* device = nullptr;
        const gpu::ComputeLayout* layout = nullptr; ///< of skinning::DeformKernels
        const InstanceWindows* windows = nullptr;
        VkBuffer table = VK_NULL_HANDLE;
        VkDeviceSize tableBytes = 0;
        InstanceArray source;           ///< poses; or, to gather a piece of a cage, the whole deformed cage
        InstanceArray target;           ///< the deformed cage
        VkBuffer list = VK_NULL_HANDLE; ///< of instances
        VkDeviceSize listBytes = 0;     ///< that the pass reads
    };
    [[nodiscard]] Status create(const Desc& desc);

    [[nodiscard]] bool empty() const { return sets_.empty(); }
    [[nodiscard]] const gpu::BoundSet& operator[](uint32_t window) const { return sets_[window]; }

private:
    gpu::TexelViews views_;
    gpu::BoundSets sets_;
};

} // namespace supple::runtime
