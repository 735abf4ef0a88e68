#include "runtime/instance_windows.h"

#include <string>

namespace supple::runtime {

Result<InstanceWindows> InstanceWindows::layOut(const gpu::Device& device, uint32_t capacity, BoundBytes bound) {
    const VkDeviceSize storageLimit = device.limits.maxStorageBufferRange;
    VkDeviceSize fit = device.bufferWindow(16) / std::max<VkDeviceSize>(bound.texels, 1);
    if (bound.storage > 0) {
        fit = std::min(fit, storageLimit / bound.storage);
    }
    if (fit == 0) {
        return Error{ErrorCode::limit, "one instance exceeds the device's storage-buffer range of " +
                                           std::to_string(storageLimit) + " bytes"};
    }
    InstanceWindows windows;
    windows.capacity = capacity;
    windows.size = static_cast<uint32_t>(std::min<VkDeviceSize>(fit, capacity));
    windows.drawSize = capacity;
    windows.listed.resize((capacity + windows.size - 1) / windows.size);
    return windows;
}

} // namespace supple::runtime
