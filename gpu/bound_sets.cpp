#include "gpu/bound_sets.h"

#include "gpu/tasks.h"

namespace supple::gpu {

Status BoundSets::create(const Device& device, const ComputeLayout& layout, uint32_t count, const char* name) {
    if (layout.ofTasks) {
        buffers_ = std::make_unique<TaskBuffers[]>(count);
        for (uint32_t i = 0; i < count; ++i) {
            sets_.push_back({VK_NULL_HANDLE, &buffers_[i]});
        }
        return success();
    }
    Result<DescriptorPoolHandle> pool = createDescriptorPool(device, layout, count, name);
    if (!pool) {
        return pool.error();
    }
    pool_ = std::move(*pool);
    for (uint32_t i = 0; i < count; ++i) {
        const Result<VkDescriptorSet> set = allocateSet(device, layout, pool_.get(), name);
        if (!set) {
            return set.error();
        }
        sets_.push_back({*set, nullptr});
    }
    return success();
}

void BoundSets::write(const Device& device, const ComputeLayout& layout, size_t index,
                      std::span<const BoundResource> resources) {
    if (!layout.ofTasks) {
        writeSet(device, layout, sets_[index].set, resources);
        return;
    }
    for (const BoundResource& resource : resources) {
        if (resource.buffer.buffer != VK_NULL_HANDLE) { // tasks read no texels
            buffers_[index].at[resource.binding] = addressOf(device, resource.buffer.buffer) + resource.buffer.offset;
        }
    }
}

} // namespace supple::gpu
