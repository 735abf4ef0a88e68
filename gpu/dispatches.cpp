#include "gpu/dispatches.h"

#include "gpu/device.h"

namespace supple::gpu {

void SingleDispatches::dispatch(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push,
                                uint64_t groups) {
    bind(device(), commandBuffer(), kernel, bound.set, push);
    dispatchLinear(device(), commandBuffer(), groups);
}

void SingleDispatches::dispatchIndirect(const Kernel& kernel, const BoundSet& bound, std::span<const std::byte> push,
                                        VkBuffer arguments, VkDeviceSize offset) {
    bind(device(), commandBuffer(), kernel, bound.set, push);
    device().vk.CmdDispatchIndirect(commandBuffer(), arguments, offset);
}

} // namespace supple::gpu
