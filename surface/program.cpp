#include "surface/program.h"

#include <algorithm>
#include <initializer_list>

namespace supple::surface {

namespace {

std::vector<DispatchSize> sizesOf(std::initializer_list<const Steps*> passes) {
    std::vector<DispatchSize> sizes;
    for (const Steps* steps : passes) {
        for (const Step& step : *steps) {
            if (step.size.isOneGroup()) {
                continue;
            }
            sizes.resize(std::max<size_t>(sizes.size(), step.argument + 1));
            sizes[step.argument] = step.size;
        }
    }
    return sizes;
}

void recordBarrier(const gpu::Device& device, VkCommandBuffer commandBuffer, Order order) {
    if (order == Order::after) {
        gpu::computeBarrier(device, commandBuffer);
    } else if (order != Order::free) {
        gpu::disjointBarrier(device, commandBuffer);
    }
}

/// Whether a step waits for a round of its own.
bool beginsRound(const Step& step) {
    return step.order == Order::disjoint || step.order == Order::after;
}

void dispatch(const gpu::Device& device, VkCommandBuffer commandBuffer, const Step& step, const Window& window) {
    std::array<std::byte, gpu::kPushConstantBytes> push = step.push;
    std::memcpy(push.data(), &window.push, sizeof(window.push));
    gpu::bind(device, commandBuffer, step.kernel, window.sets[static_cast<size_t>(step.sets)],
              std::span<const std::byte>(push).first(step.pushBytes));
    if (step.size.isOneGroup()) {
        device.vk.CmdDispatch(commandBuffer, 1, 1, 1);
    } else if (window.arguments != VK_NULL_HANDLE) {
        device.vk.CmdDispatchIndirect(commandBuffer, window.arguments,
                                      window.firstArgument + step.argument * window.argumentStride);
    } else {
        const uint64_t elements = uint64_t{step.size.elements} * window.push.instanceCount;
        gpu::dispatchLinear(device, commandBuffer, (elements + step.size.perGroup - 1) / step.size.perGroup);
    }
}

} // namespace

bool Round::advance() {
    if (next == Order::free) {
        return false;
    }
    recordBarrier(device, commandBuffer, next);
    ++number;
    next = Order::free;
    return true;
}

void record(Round& round, std::span<const Step> steps, const Window& window) {
    uint32_t number = 0;
    for (const Step& step : steps) {
        number += beginsRound(step) ? 1 : 0;
        if (number > round.number) {
            round.next = std::max(round.next, step.order);
            return;
        }
        if (number == round.number) {
            dispatch(round.device, round.commandBuffer, step, window);
        }
    }
}

void record(const gpu::Device& device, VkCommandBuffer commandBuffer, std::span<const Step> steps,
            const Window& window) {
    for (const Step& step : steps) {
        recordBarrier(device, commandBuffer, step.order);
        dispatch(device, commandBuffer, step, window);
    }
}

void Program::setCamera(const shared::LodCamera& camera) {
    for (Steps* steps : {&edgeLevels, &patchLevels, &depths, &places}) {
        for (Step& step : *steps) {
            std::memcpy(step.push.data() + offsetof(shared::LodPush, camera), &camera, sizeof(camera));
        }
    }
}

std::vector<DispatchSize> Program::constructionSizes() const {
    return sizesOf({&vertex, &assemble, &edgeLevels, &patchLevels, &places});
}

std::vector<DispatchSize> Program::evaluationSizes() const {
    return sizesOf({&evaluate});
}

} // namespace supple::surface
