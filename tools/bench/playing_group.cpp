#include "tools/bench/playing_group.h"

#include "host/vk_struct.h"

#include <algorithm>
#include <glm/glm.hpp>

namespace supple::bench {

namespace {

/// The size of the largest heap on the device, in bytes.
VkDeviceSize deviceMemory(const host::Device& device) {
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(device.physicalDevice(), &memory);
    VkDeviceSize largest = 0;
    for (uint32_t h = 0; h < memory.memoryHeapCount; ++h) {
        if ((memory.memoryHeaps[h].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0) {
            largest = std::max(largest, memory.memoryHeaps[h].size);
        }
    }
    return largest;
}

/// Bytes of the largest buffer that can be allocated and bound.
VkDeviceSize largestBuffer(const host::Device& device) {
    auto allocation = host::vkStruct<VkPhysicalDeviceMaintenance3Properties>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES);
    auto properties = host::vkStruct<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    properties.pNext = &allocation;
    vkGetPhysicalDeviceProperties2(device.physicalDevice(), &properties);
    return std::min<VkDeviceSize>(allocation.maxMemoryAllocationSize,
                                  properties.properties.limits.maxStorageBufferRange);
}

} // namespace

uint32_t charactersThatFit(const host::Device& device, VkDeviceSize bytes, VkDeviceSize ofLargestBuffer,
                           uint32_t wanted) {
    constexpr VkDeviceSize kShareOfMemory = 4;
    const VkDeviceSize inMemory = deviceMemory(device) / kShareOfMemory / std::max<VkDeviceSize>(bytes, 1);
    const VkDeviceSize inBuffer = largestBuffer(device) / std::max<VkDeviceSize>(ofLargestBuffer, 1);
    return static_cast<uint32_t>(std::clamp<VkDeviceSize>(std::min(inMemory, inBuffer), 1, wanted));
}

PlayingGroup::~PlayingGroup() {
    if (group_.id != 0) {
        workbench_.destroy(group_);
    }
}

Status PlayingGroup::create(SuppleGroupDesc desc) {
    desc.poseSource = SUPPLE_POSES_PLAYBACK;
    Result<SuppleGroup> made = workbench_.createGroup(desc);
    if (!made) {
        return made.error();
    }
    group_ = *made;
    Status recorded = success();
    const Status submitted =
        device_.submitAndWait([&](VkCommandBuffer commands) { recorded = workbench_.recordFrame(group_, commands); });
    return recorded ? submitted : recorded;
}

Result<std::unique_ptr<Replay>> PlayingGroup::replay(Passes passes) const {
    return Replay::create(device_, [&](VkCommandBuffer commands) {
        switch (passes) {
        case Passes::evaluate:
            return workbench_.recordEvaluate(group_, commands);
        case Passes::skin:
            return workbench_.recordSkin(group_, commands);
        case Passes::frame:
            return workbench_.recordCompute(group_, commands);
        }
    });
}

Result<std::vector<std::byte>> PlayingGroup::verticesOf(uint32_t instance) const {
    const host::GroupOutput out = output();
    const SuppleBufferRange all = out.streams.vertices;
    const VkDeviceSize stride = VkDeviceSize{out.grid.verticesPerInstance} * all.stride;
    return device_.readBuffer(all.buffer, all.offset + instance * stride,
                              VkDeviceSize{out.grid.vertexCount} * all.stride);
}

Result<std::vector<std::byte>> PlayingGroup::deformedCageOf(uint32_t instance) const {
    const SuppleGroupInfo info = output().info;
    const VkDeviceSize stride = VkDeviceSize{info.cageVerticesPerInstance} * sizeof(glm::vec4);
    return device_.readBuffer(info.deformedCage.buffer, info.deformedCage.offset + instance * stride,
                              VkDeviceSize{info.cageVertexCount} * sizeof(glm::vec4));
}

} // namespace supple::bench
