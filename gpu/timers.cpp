#include "gpu/timers.h"

#include "gpu/barriers.h"

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
    if (!device.mapping.lazyTimestamps) {
        timers.raw_.resize(capacity);
        return timers;
    }
    const BufferRequest request{name, capacity * sizeof(Tick), VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    Result<BufferSet> readback = BufferSet::create(device, {&request, 1}, MemoryKind::readback);
    if (!readback) {
        return readback.error();
    }
    timers.readback_ = std::move(*readback);
    std::fill_n(timers.copied(), capacity, Tick{});
    return timers;
}

Timers::Timers(Timers&& other) noexcept
    : device_(other.device_), pool_(std::move(other.pool_)), capacity_(other.capacity_), taken_(other.taken_.load()),
      readback_(std::move(other.readback_)), raw_(std::move(other.raw_)) {}

Timers& Timers::operator=(Timers&& other) noexcept {
    device_ = other.device_;
    pool_ = std::move(other.pool_);
    capacity_ = other.capacity_;
    taken_ = other.taken_.load();
    readback_ = std::move(other.readback_);
    raw_ = std::move(other.raw_);
    return *this;
}

void Timers::clear() {
    const uint32_t count = taken_.exchange(0);
    if (copies()) {
        std::fill_n(copied(), count, Tick{}); // not available again before the device has copied them anew
    }
}

bool Timers::take(VkCommandBuffer commandBuffer, uint32_t count, uint32_t& first) {
    first = taken_.load();
    do {
        if (count > capacity_ - first) {
            return false;
        }
    } while (!taken_.compare_exchange_weak(first, first + count));
    device_->vk.CmdResetQueryPool(commandBuffer, pool_.get(), first, count);
    return true;
}

void Timers::mark(VkCommandBuffer commandBuffer, uint32_t index) const {
    device_->vk.CmdWriteTimestamp(commandBuffer, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool_.get(), index);
    if (device_->mapping.lazyTimestamps) {
        memoryBarrier(*device_, commandBuffer, {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0},
                      {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0});
    }
}

void Timers::finish(VkCommandBuffer commandBuffer, uint32_t first, uint32_t count) const {
    if (!copies()) {
        return;
    }
    device_->vk.CmdCopyQueryPoolResults(
        commandBuffer, pool_.get(), first, count, readback_.buffer(0), first * sizeof(Tick), sizeof(Tick),
        VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WITH_AVAILABILITY_BIT | VK_QUERY_RESULT_WAIT_BIT);
    memoryBarrier(*device_, commandBuffer, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                  {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
}

Result<std::span<const Timers::Tick>> Timers::read() {
    const uint32_t count = taken_.load();
    if (count == 0) {
        return std::span<const Tick>();
    }
    if (copies()) {
        return std::span<const Tick>(copied(), count);
    }
    const VkResult result =
        device_->vk.GetQueryPoolResults(device_->handle, pool_.get(), 0, count, count * sizeof(Tick), raw_.data(),
                                        sizeof(Tick), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WITH_AVAILABILITY_BIT);
    if (result != VK_SUCCESS && result != VK_NOT_READY) {
        return vulkanError(result, "reading timestamps");
    }
    return std::span<const Tick>(raw_.data(), count);
}

} // namespace supple::gpu
