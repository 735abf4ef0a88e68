#include "gpu/timers.h"

#include <string>

namespace supple::gpu {

Result<Timers> Timers::create(const Device& device, uint32_t capacity, const char* name) {
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = capacity;
    VkQueryPool pool = VK_NULL_HANDLE;
    const VkResult result = device.vk.CreateQueryPool(device.handle, &info, device.allocator, &pool);
    if (result != VK_SUCCESS) {
        return vulkanError(result, std::string("query pool of ") + name);
    }
    device.setName(VK_OBJECT_TYPE_QUERY_POOL, reinterpret_cast<uint64_t>(pool), name);
    Timers timers;
    timers.device_ = &device;
    timers.pool_ = QueryPoolHandle(device, pool);
    timers.capacity_ = capacity;
    timers.raw_.resize(capacity);
    return timers;
}

void Timers::reset(VkCommandBuffer commandBuffer) {
    device_->vk.CmdResetQueryPool(commandBuffer, pool_.get(), 0, capacity_);
    count_ = 0;
}

bool Timers::mark(VkCommandBuffer commandBuffer, uint32_t& index) {
    if (count_ == capacity_) {
        return false;
    }
    index = count_++;
    device_->vk.CmdWriteTimestamp2(commandBuffer, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool_.get(), index);
    return true;
}

std::span<const uint64_t> Timers::read() {
    if (count_ == 0) {
        return {};
    }
    const VkResult result =
        device_->vk.GetQueryPoolResults(device_->handle, pool_.get(), 0, count_, count_ * sizeof(uint64_t), raw_.data(),
                                        sizeof(uint64_t), VK_QUERY_RESULT_64_BIT);
    if (result != VK_SUCCESS) { // VK_NOT_READY included
        return {};
    }
    return {raw_.data(), count_};
}

} // namespace supple::gpu
