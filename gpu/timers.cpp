#include "gpu/timers.h"

#include <algorithm>
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

bool Timers::read(std::span<double> nanoseconds) {
    const uint32_t n = std::min(count_, static_cast<uint32_t>(nanoseconds.size()));
    if (n == 0) {
        return false;
    }
    const VkResult result = device_->vk.GetQueryPoolResults(device_->handle, pool_.get(), 0, n, n * sizeof(uint64_t),
                                                            raw_.data(), sizeof(uint64_t), VK_QUERY_RESULT_64_BIT);
    if (result != VK_SUCCESS) { // VK_NOT_READY included
        return false;
    }
    const uint64_t mask = device_->timestampValidBits >= 64 ? ~0ull : (1ull << device_->timestampValidBits) - 1;
    const uint64_t first = raw_[0] & mask;
    for (uint32_t i = 0; i < n; ++i) {
        const uint64_t elapsed = ((raw_[i] & mask) - first) & mask;
        nanoseconds[i] = (static_cast<double>(first) + static_cast<double>(elapsed)) *
                         static_cast<double>(device_->limits.timestampPeriod);
    }
    return true;
}

} // namespace supple::gpu
