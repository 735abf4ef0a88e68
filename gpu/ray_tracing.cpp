#include "gpu/ray_tracing.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

namespace supple::gpu {

namespace {

constexpr std::array<const char*, 2> kExtensions{VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                                 VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

std::vector<VkExtensionProperties> extensionsOf(const Functions& vk, VkPhysicalDevice physicalDevice) {
    uint32_t count = 0;
    vk.EnumerateDeviceExtensionProperties(physicalDevice, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vk.EnumerateDeviceExtensionProperties(physicalDevice, nullptr, &count, extensions.data());
    extensions.resize(count);
    return extensions;
}

} // namespace

std::span<const char* const> rayTracingExtensions() {
    return kExtensions;
}

std::string missingForRayTracing(VkInstance instance, VkPhysicalDevice physicalDevice,
                                 PFN_vkGetInstanceProcAddr getInstanceProcAddr) {
    Functions vk;
    vk.loadInstance(instance, getInstanceProcAddr);
    const std::vector<VkExtensionProperties> offered = extensionsOf(vk, physicalDevice);
    for (const char* name : kExtensions) {
        const bool isThere = std::any_of(offered.begin(), offered.end(), [&](const VkExtensionProperties& extension) {
            return std::strcmp(extension.extensionName, name) == 0;
        });
        if (!isThere) {
            return std::string("extension ") + name;
        }
    }
    if (std::string missing = missingForAddresses(instance, physicalDevice, getInstanceProcAddr); !missing.empty()) {
        return missing;
    }
    VkPhysicalDeviceAccelerationStructureFeaturesKHR structures{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    features.pNext = &structures;
    vk.GetPhysicalDeviceFeatures2(physicalDevice, &features);
    return structures.accelerationStructure == VK_TRUE ? "" : "feature accelerationStructure";
}

std::string disabledForRayTracing(const void* chain) {
    if (!enablesAddresses(chain)) {
        return "bufferDeviceAddress";
    }
    for (const auto* next = static_cast<const VkBaseInStructure*>(chain); next != nullptr; next = next->pNext) {
        if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR) {
            const auto& own = *reinterpret_cast<const VkPhysicalDeviceAccelerationStructureFeaturesKHR*>(next);
            return own.accelerationStructure == VK_TRUE ? "" : "accelerationStructure";
        }
    }
    return "accelerationStructure";
}

} // namespace supple::gpu
