#include "tools/bench/replay.h"

#include "host/vk_struct.h"

#include <vector>

namespace supple::bench {

Result<std::unique_ptr<Replay>> Replay::create(host::Device& device,
                                               const std::function<void(VkCommandBuffer)>& record) {
    std::unique_ptr<Replay> replay(new Replay(device));
    VkResult result = replay->createObjects();
    for (const VkCommandBuffer commands : {replay->plain_, replay->timed_}) {
        if (result != VK_SUCCESS || commands == VK_NULL_HANDLE) {
            continue;
        }
        auto begin = host::vkStruct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
        result = vkBeginCommandBuffer(commands, &begin);
        const bool timed = commands == replay->timed_ && replay->hasTimestamps();
        if (timed) {
            vkCmdResetQueryPool(commands, replay->queries_, 0, 2);
            vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, replay->queries_, 0);
        }
        record(commands);
        if (timed) {
            vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, replay->queries_, 1);
        }
        if (result == VK_SUCCESS) {
            result = vkEndCommandBuffer(commands);
        }
    }
    if (result != VK_SUCCESS) {
        return host::vulkanError(result, "recording a benchmark");
    }
    return replay;
}

VkResult Replay::createObjects() {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device_.physicalDevice(), &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device_.physicalDevice(), &count, families.data());
    const uint32_t bits = families[device_.queueFamily()].timestampValidBits;
    tickMask_ = bits >= 64 ? ~uint64_t{0} : (uint64_t{1} << bits) - 1;

    auto allocate = host::vkStruct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocate.commandPool = device_.commandPool();
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    VkResult result = vkAllocateCommandBuffers(device_.handle(), &allocate, &plain_);
    if (result == VK_SUCCESS && bits > 0) {
        result = vkAllocateCommandBuffers(device_.handle(), &allocate, &timed_);
    }
    if (result == VK_SUCCESS) {
        const auto fence = host::vkStruct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
        result = vkCreateFence(device_.handle(), &fence, nullptr, &fence_);
    }
    if (result == VK_SUCCESS && bits > 0) {
        auto pool = host::vkStruct<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
        pool.queryType = VK_QUERY_TYPE_TIMESTAMP;
        pool.queryCount = 2;
        result = vkCreateQueryPool(device_.handle(), &pool, nullptr, &queries_);
    }
    return result;
}

Replay::~Replay() {
    vkDestroyQueryPool(device_.handle(), queries_, nullptr);
    vkDestroyFence(device_.handle(), fence_, nullptr);
    for (const VkCommandBuffer commands : {plain_, timed_}) {
        if (commands != VK_NULL_HANDLE) {
            vkFreeCommandBuffers(device_.handle(), device_.commandPool(), 1, &commands);
        }
    }
}

Contestant Replay::contestant(const std::string& name, uint64_t points) {
    Contestant contestant{name, points, [this](uint32_t times) { return run(times); }, nullptr};
    if (hasTimestamps()) {
        contestant.deviceSeconds = [this](uint32_t times) { return deviceSeconds(times); };
    }
    return contestant;
}

Status Replay::submit(VkCommandBuffer commands, uint32_t times) {
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < times && result == VK_SUCCESS; ++i) {
        auto submit = host::vkStruct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
        submit.commandBufferCount = 1;
        submit.pCommandBuffers = &commands;
        result = vkResetFences(device_.handle(), 1, &fence_);
        if (result == VK_SUCCESS) {
            result = vkQueueSubmit(device_.queue(), 1, &submit, fence_);
        }
        if (result == VK_SUCCESS) {
            result = vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, UINT64_MAX);
        }
    }
    return result == VK_SUCCESS ? success() : Status(host::vulkanError(result, "replaying a benchmark"));
}

Result<double> Replay::deviceSeconds(uint32_t times) {
    double total = 0.0;
    for (uint32_t i = 0; i < times; ++i) {
        const Status status = submit(timed_, 1);
        if (!status) {
            return status.error();
        }
        uint64_t ticks[2] = {};
        const VkResult result =
            vkGetQueryPoolResults(device_.handle(), queries_, 0, 2, sizeof ticks, ticks, sizeof ticks[0],
                                  VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
        if (result != VK_SUCCESS) {
            return host::vulkanError(result, "reading timestamps");
        }
        total += static_cast<double>((ticks[1] - ticks[0]) & tickMask_);
    }
    return total * 1e-9 * static_cast<double>(device_.properties().limits.timestampPeriod) / times;
}

} // namespace supple::bench
