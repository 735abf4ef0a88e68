// Compute pipelines from embedded SPIR-V, their layouts, and descriptor sets.
#pragma once

#include "base/result.h"
#include "gpu/handle.h"
#include "gpu/spirv.h"

#include <span>
#include <vector>

namespace supple::gpu {

struct Binding {
    uint32_t binding = 0;
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
};

/// One descriptor set (set 0) and one push-constant block, both for the compute stage.
struct ComputeLayout {
    std::vector<Binding> bindings;
    SetLayoutHandle setLayout;
    PipelineLayoutHandle pipelineLayout;

    [[nodiscard]] static Result<ComputeLayout> create(const Device& device, std::span<const Binding> bindings,
                                                      uint32_t pushBytes, const char* name);
};

struct Constant {
    uint32_t id = 0;
    uint32_t value = 0; ///< bool constants: VK_TRUE or VK_FALSE
};

/// Of the device's mapping, whose constants are added to `constants`.
[[nodiscard]] Result<PipelineHandle> createComputePipeline(const Device& device, const ComputeLayout& layout,
                                                           const Spirv& spirv, std::span<const Constant> constants,
                                                           const char* name);

/// A pool for `setCount` sets of `layout` and nothing else.
[[nodiscard]] Result<DescriptorPoolHandle> createDescriptorPool(const Device& device, const ComputeLayout& layout,
                                                                uint32_t setCount, const char* name);
[[nodiscard]] Result<VkDescriptorSet> allocateSet(const Device& device, const ComputeLayout& layout,
                                                  VkDescriptorPool pool, const char* name);

/// What one binding of a set sees: a buffer range or a texel view.
struct BoundResource {
    uint32_t binding = 0;
    VkDescriptorBufferInfo buffer{};
    VkBufferView texels = VK_NULL_HANDLE; ///< set for texel bindings
};
void writeSet(const Device& device, VkDescriptorSet set, std::span<const BoundResource> resources);

/// What a dispatch may have in x: the least that devices must take at most, so that splits are the same everywhere.
[[nodiscard]] uint32_t maxGroupsInX(const Device& device);

/// Records a dispatch of at least `groups` workgroups, split in x and y at the device's limit
/// (shaders/shared/mapping.glsl puts the linear index together again).
void dispatchLinear(const Device& device, VkCommandBuffer commandBuffer, uint64_t groups);

} // namespace supple::gpu
