// Compute pipelines from embedded SPIR-V, their layouts, and descriptor sets.
#pragma once

#include "base/result.h"
#include "gpu/handle.h"
#include "gpu/spirv.h"
#include "shaders/shared/tasks.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace supple::gpu {

/// One binding of a layout. What a kernel only reads, it reads through a storage buffer in the wide mapping and through
/// texels in the narrow one: such data has a binding for each, and a layout has those of its device's mapping.
struct Binding {
    enum class In : uint32_t { either, narrow, wide };
    uint32_t binding = 0;
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    In mapping = In::either;

    [[nodiscard]] constexpr bool isIn(bool wide) const {
        return mapping == In::either || (mapping == In::wide) == wide;
    }
};
/// A few words that all lanes read alike.
[[nodiscard]] constexpr Binding uniform(uint32_t binding) {
    return {binding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, Binding::In::either};
}
/// What kernels of both mappings bind as a storage buffer: what they write.
[[nodiscard]] constexpr Binding storage(uint32_t binding) {
    return {binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, Binding::In::either};
}
/// The two ways to read.
[[nodiscard]] constexpr Binding wideStorage(uint32_t binding) {
    return {binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, Binding::In::wide};
}
[[nodiscard]] constexpr Binding narrowTexels(uint32_t binding) {
    return {binding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, Binding::In::narrow};
}

/// One descriptor set (set 0) and one push-constant block, both for the compute stage.
struct ComputeLayout {
    std::vector<Binding> bindings; ///< of the device's mapping
    SetLayoutHandle setLayout;
    PipelineLayoutHandle pipelineLayout;
    bool ofTasks = false; ///< no bindings, the push constants of shared dispatches

    [[nodiscard]] static Result<ComputeLayout> create(const Device& device, std::span<const Binding> bindings,
                                                      uint32_t pushBytes, const char* name);
    /// For kernels that can share dispatches (gpu::Spirv::tasks). If the device's mapping shares them, it is a layout
    /// of tasks: no bindings, and the push constants of shared dispatches.
    [[nodiscard]] static Result<ComputeLayout> ofShared(const Device& device, std::span<const Binding> bindings,
                                                        uint32_t pushBytes, const char* name);
};

struct Constant {
    uint32_t id = 0;
    uint32_t value = 0; ///< bool constants: VK_TRUE or VK_FALSE

    bool operator==(const Constant&) const = default;
};

/// What the device's mapping runs.
[[nodiscard]] inline std::span<const uint32_t> wordsOf(const Device& device, const Spirv& spirv) {
    if (device.mapping.sharesDispatches && !spirv.tasks.empty()) {
        return spirv.tasks;
    }
    return device.mapping.wide ? spirv.wide : spirv.narrow;
}

/// The constants of the device's mapping are added to `constants`. gpu::Pipelines keeps what is made here.
/// Any thread may call it.
[[nodiscard]] Result<PipelineHandle> createComputePipeline(const Device& device, VkPipelineLayout layout,
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
/// Resources whose binding the layout lacks are skipped: a caller hands over all it has, whatever the layout.
void writeSet(const Device& device, const ComputeLayout& layout, VkDescriptorSet set,
              std::span<const BoundResource> resources);

/// A pipeline, to be bound. Owns nothing.
struct Kernel {
    const PipelineHandle* pipeline = nullptr; ///< of gpu::Pipelines, which may make it later
    VkPipelineLayout layout = VK_NULL_HANDLE;
};
/// Records the pipeline, its set and its push constants: all that a dispatch needs before it.
void bind(const Device& device, VkCommandBuffer commandBuffer, const Kernel& kernel, VkDescriptorSet set,
          std::span<const std::byte> push);
template <class Push>
void bind(const Device& device, VkCommandBuffer commandBuffer, const Kernel& kernel, VkDescriptorSet set,
          const Push& push) {
    bind(device, commandBuffer, kernel, set, std::as_bytes(std::span(&push, 1)));
}

/// The same for a kernel that binds no set.
void bindByAddress(const Device& device, VkCommandBuffer commandBuffer, const Kernel& kernel,
                   std::span<const std::byte> push);
template <class Push>
void bindByAddress(const Device& device, VkCommandBuffer commandBuffer, const Kernel& kernel, const Push& push) {
    bindByAddress(device, commandBuffer, kernel, std::as_bytes(std::span(&push, 1)));
}

/// What a dispatch may have in x: the least that devices must take at most, so that splits are the same everywhere.
[[nodiscard]] uint32_t maxGroupsInX(const Device& device);

/// Records a dispatch of at least `groups` workgroups, split in x and y at the device's limit
/// (shaders/shared/mapping.glsl puts the linear index together again). 0 workgroups do nothing, but drivers that
/// compile a pipeline at its first dispatch do it then.
void dispatchLinear(const Device& device, VkCommandBuffer commandBuffer, uint64_t groups);

} // namespace supple::gpu
