#include "gpu/host_memory.h"

#include "gpu/device.h"

#include <string>

namespace supple::gpu {

namespace {

constexpr uint32_t kNoType = 0xFFFFFFFFu;

uint32_t findMemoryType(const Device& device, uint32_t typeBits, VkMemoryPropertyFlags wanted) {
    for (uint32_t i = 0; i < device.memory.memoryTypeCount; ++i) {
        if ((typeBits & (1u << i)) != 0 && (device.memory.memoryTypes[i].propertyFlags & wanted) == wanted) {
            return i;
        }
    }
    return kNoType;
}

} // namespace

Result<HostMemory> allocateHostMemory(const Device& device, const VkMemoryRequirements& requirements, MemoryKind kind,
                                      const char* name, const std::string& what) {
    // Every device has a type of memory that is both visible and coherent, for all buffers.
    const bool mapped = kind != MemoryKind::deviceLocal;
    const VkMemoryPropertyFlags required =
        mapped ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT : 0;
    VkMemoryPropertyFlags preferred = required;
    if (kind == MemoryKind::deviceLocal) {
        preferred = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    } else if (kind == MemoryKind::readback) {
        preferred |= VK_MEMORY_PROPERTY_HOST_CACHED_BIT; // else the CPU reads slowly
    }
    HostMemory memory;
    if (device.memorySource.allocate) {
        const VkResult result = device.memorySource.allocate(requirements, required, preferred, name, memory);
        if (result == VK_SUCCESS && (memory.memory == VK_NULL_HANDLE || (mapped && memory.mapped == nullptr))) {
            device.memorySource.free(memory); // every success has its free
            return Error{ErrorCode::argument, what + ": the host's callback gave none, or did not map it"};
        }
        return result == VK_SUCCESS ? Result<HostMemory>(memory) : vulkanError(result, what);
    }
    uint32_t type = findMemoryType(device, requirements.memoryTypeBits, required | preferred);
    if (type == kNoType) {
        type = findMemoryType(device, requirements.memoryTypeBits, required);
    }
    if (type == kNoType) {
        return Error{ErrorCode::unsupported, what + ": no suitable memory type"};
    }
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.allocationSize = requirements.size;
    info.memoryTypeIndex = type;
    VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO};
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    info.pNext = device.givesAddresses() ? &flags : nullptr;
    VkResult result = device.vk.AllocateMemory(device.handle, &info, device.allocator, &memory.memory);
    if (result != VK_SUCCESS) {
        return vulkanError(result, what);
    }
    device.setName(VK_OBJECT_TYPE_DEVICE_MEMORY, reinterpret_cast<uint64_t>(memory.memory), name);
    if (mapped) {
        result = device.vk.MapMemory(device.handle, memory.memory, 0, VK_WHOLE_SIZE, 0, &memory.mapped);
        if (result != VK_SUCCESS) {
            freeHostMemory(device, memory);
            return vulkanError(result, std::string("mapping ") + name);
        }
    }
    return memory;
}

void freeHostMemory(const Device& device, const HostMemory& memory) {
    if (device.memorySource.free) {
        device.memorySource.free(memory);
    } else {
        device.vk.FreeMemory(device.handle, memory.memory, device.allocator);
    }
}

} // namespace supple::gpu
