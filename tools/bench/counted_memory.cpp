#include "tools/bench/counted_memory.h"

#include "host/vk_struct.h"

namespace supple::bench {

namespace {

constexpr uint32_t kNoType = UINT32_MAX;

uint32_t memoryType(const VkPhysicalDeviceMemoryProperties& properties, uint32_t allowed, VkMemoryPropertyFlags flags) {
    for (uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
        if ((allowed & (1u << i)) != 0 && (properties.memoryTypes[i].propertyFlags & flags) == flags) {
            return i;
        }
    }
    return kNoType;
}

} // namespace

CountedMemory::CountedMemory(const host::Device& device) : device_(device.handle()) {
    vkGetPhysicalDeviceMemoryProperties(device.physicalDevice(), &properties_);
    callbacks_ = {&CountedMemory::allocate, &CountedMemory::free, this};
}

VkResult CountedMemory::allocate(const VkMemoryRequirements* requirements, VkMemoryPropertyFlags required,
                                 VkMemoryPropertyFlags preferred, const char*, SuppleMemory* out, void* user) {
    CountedMemory& own = *static_cast<CountedMemory*>(user);
    uint32_t type = memoryType(own.properties_, requirements->memoryTypeBits, required | preferred);
    if (type == kNoType) {
        type = memoryType(own.properties_, requirements->memoryTypeBits, required);
    }
    if (type == kNoType) {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    auto info = host::vkStruct<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = requirements->size;
    info.memoryTypeIndex = type;
    auto flags = host::vkStruct<VkMemoryAllocateFlagsInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO);
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT; // SUPPLE_CONTEXT_SHARED_DISPATCHES
    info.pNext = &flags;
    *out = {};
    VkResult result = vkAllocateMemory(own.device_, &info, nullptr, &out->memory);
    if (result == VK_SUCCESS && (required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
        result = vkMapMemory(own.device_, out->memory, 0, VK_WHOLE_SIZE, 0, &out->mapped);
        if (result != VK_SUCCESS) {
            vkFreeMemory(own.device_, out->memory, nullptr);
        }
    }
    own.allocations_ += result == VK_SUCCESS ? 1 : 0;
    return result;
}

void CountedMemory::free(const SuppleMemory* memory, void* user) {
    CountedMemory& own = *static_cast<CountedMemory*>(user);
    vkFreeMemory(own.device_, memory->memory, nullptr); // unmaps it, too
    ++own.frees_;
}

} // namespace supple::bench
