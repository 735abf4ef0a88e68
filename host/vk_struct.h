// Vulkan structs begin zeroed, with their type set.
#pragma once

#include <vulkan/vulkan.h>

namespace supple::host {

template <class T>
[[nodiscard]] T vkStruct(VkStructureType type, const void* next = nullptr) {
    T value{};
    value.sType = type;
    value.pNext = const_cast<void*>(next);
    return value;
}

} // namespace supple::host
