#include "host/frames.h"

#include "host/must.h"

namespace supple::host {

Frames::Frames(const Device& device) : device_(device) {
    const VkSemaphoreTypeCreateInfo type{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                         .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE};
    const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, .pNext = &type};
    must(vkCreateSemaphore(device.handle(), &info, nullptr, &timeline_), "vkCreateSemaphore");
    for (uint32_t i = 0; i < kFramesInFlight; ++i) {
        const VkCommandPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                               .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                               .queueFamilyIndex = device.queueFamily()};
        must(vkCreateCommandPool(device.handle(), &poolInfo, nullptr, &pools_[i]), "vkCreateCommandPool");
        const VkCommandBufferAllocateInfo commandInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                      .commandPool = pools_[i],
                                                      .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                      .commandBufferCount = 1};
        must(vkAllocateCommandBuffers(device.handle(), &commandInfo, &commands_[i]), "vkAllocateCommandBuffers");
    }
}

Frames::~Frames() {
    device_.waitIdle();
    for (const VkCommandPool pool : pools_)
        vkDestroyCommandPool(device_.handle(), pool, nullptr);
    vkDestroySemaphore(device_.handle(), timeline_, nullptr);
}

void Frames::waitForRoom() const {
    const uint64_t earlier = frame_ + 1 > kFramesInFlight ? frame_ + 1 - kFramesInFlight : 0;
    const VkSemaphoreWaitInfo wait{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                   .semaphoreCount = 1,
                                   .pSemaphores = &timeline_,
                                   .pValues = &earlier};
    must(vkWaitSemaphores(device_.handle(), &wait, UINT64_MAX), "vkWaitSemaphores");
}

VkCommandBuffer Frames::begin() {
    waitForRoom();
    ++frame_;
    must(vkResetCommandPool(device_.handle(), pools_[slot()], 0), "vkResetCommandPool");
    const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    must(vkBeginCommandBuffer(commands_[slot()], &info), "vkBeginCommandBuffer");
    return commands_[slot()];
}

void Frames::submit(VkSemaphore acquired, VkPipelineStageFlags2 acquiredStages, VkSemaphore drawn) {
    must(vkEndCommandBuffer(commands_[slot()]), "vkEndCommandBuffer");
    const VkCommandBufferSubmitInfo commands{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                             .commandBuffer = commands_[slot()]};
    const VkSemaphoreSubmitInfo wait{
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO, .semaphore = acquired, .stageMask = acquiredStages};
    const VkSemaphoreSubmitInfo signals[] = {{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                              .semaphore = timeline_,
                                              .value = frame_,
                                              .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT},
                                             {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                              .semaphore = drawn,
                                              .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT}};
    const VkSubmitInfo2 info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                             .waitSemaphoreInfoCount = acquired != VK_NULL_HANDLE ? 1u : 0u,
                             .pWaitSemaphoreInfos = &wait,
                             .commandBufferInfoCount = 1,
                             .pCommandBufferInfos = &commands,
                             .signalSemaphoreInfoCount = drawn != VK_NULL_HANDLE ? 2u : 1u,
                             .pSignalSemaphoreInfos = signals};
    must(vkQueueSubmit2(device_.queue(), 1, &info, VK_NULL_HANDLE), "vkQueueSubmit2");
}

uint64_t Frames::completed() const {
    uint64_t value = 0;
    must(vkGetSemaphoreCounterValue(device_.handle(), timeline_, &value), "vkGetSemaphoreCounterValue");
    return value;
}

} // namespace supple::host
