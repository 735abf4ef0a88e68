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

} // namespace

void record(const gpu::Device& device, VkCommandBuffer commandBuffer, std::span<const Step> steps,
            const Window& window) {
    for (const Step& step : steps) {
        if (step.order == Order::disjoint) {
            gpu::disjointBarrier(device, commandBuffer);
        } else if (step.order == Order::after) {
            gpu::computeBarrier(device, commandBuffer);
        }
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
}

void Program::setCamera(const shared::LodCamera& camera) {
    for (Steps* steps : {&edgeLevels, &patchLevels, &places}) {
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
