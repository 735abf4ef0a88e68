#include "tools/bench/playing_group.h"

#include <algorithm>
#include <glm/glm.hpp>

namespace supple::bench {

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
