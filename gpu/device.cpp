#include "gpu/device.h"

#include "gpu/fast_math.h"
#include "gpu/ray_tracing.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace supple::gpu {

namespace {

struct NamedFeature12 {
    const char* name;
    VkBool32 VkPhysicalDeviceVulkan12Features::*member;
};
struct NamedFeature13 {
    const char* name;
    VkBool32 VkPhysicalDeviceVulkan13Features::*member;
};

// The 24-byte surface vertex is stored as tightly packed vec3.
constexpr NamedFeature12 kFeatures12[] = {{"scalarBlockLayout", &VkPhysicalDeviceVulkan12Features::scalarBlockLayout}};
// maintenance4: workgroup sizes by specialization constant alone.
constexpr NamedFeature13 kFeatures13[] = {{"synchronization2", &VkPhysicalDeviceVulkan13Features::synchronization2},
                                          {"maintenance4", &VkPhysicalDeviceVulkan13Features::maintenance4}};

constexpr const char* kNewInstance = "the VkInstance must be created with apiVersion 1.3 or more";
/// No VkBool32 that a driver writes.
constexpr VkBool32 kUntouched = 2;

std::string versionText(uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version));
}

/// What the device offers of the features that are needed. Loaders answer for an instance of Vulkan 1.0 themselves, and
/// know no structs of later versions: these stay untouched.
struct OfferedFeatures {
    VkPhysicalDeviceVulkan12Features features12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceVulkan13Features features13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    bool untouched = true;

    OfferedFeatures(const Functions& vk, VkPhysicalDevice physicalDevice) {
        for (const NamedFeature12& feature : kFeatures12) {
            features12.*feature.member = kUntouched;
        }
        for (const NamedFeature13& feature : kFeatures13) {
            features13.*feature.member = kUntouched;
        }
        features12.pNext = &features13;
        VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
        features.pNext = &features12;
        vk.GetPhysicalDeviceFeatures2(physicalDevice, &features);
        for (const NamedFeature12& feature : kFeatures12) {
            untouched = untouched && features12.*feature.member == kUntouched;
        }
        for (const NamedFeature13& feature : kFeatures13) {
            untouched = untouched && features13.*feature.member == kUntouched;
        }
    }
};

const char* resultName(VkResult result) {
    switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return "VK_ERROR_OUT_OF_HOST_MEMORY";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
    case VK_ERROR_INITIALIZATION_FAILED:
        return "VK_ERROR_INITIALIZATION_FAILED";
    case VK_ERROR_DEVICE_LOST:
        return "VK_ERROR_DEVICE_LOST";
    case VK_ERROR_MEMORY_MAP_FAILED:
        return "VK_ERROR_MEMORY_MAP_FAILED";
    case VK_ERROR_TOO_MANY_OBJECTS:
        return "VK_ERROR_TOO_MANY_OBJECTS";
    case VK_ERROR_OUT_OF_POOL_MEMORY:
        return "VK_ERROR_OUT_OF_POOL_MEMORY";
    case VK_ERROR_FRAGMENTED_POOL:
        return "VK_ERROR_FRAGMENTED_POOL";
    case VK_ERROR_INVALID_SHADER_NV:
        return "VK_ERROR_INVALID_SHADER_NV";
    default:
        return "VkResult";
    }
}

} // namespace

Error vulkanError(VkResult result, const std::string& what) {
    ErrorCode code = ErrorCode::vulkan;
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY) {
        code = ErrorCode::hostMemory;
    } else if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY) {
        code = ErrorCode::deviceMemory;
    } else if (result == VK_ERROR_DEVICE_LOST) {
        code = ErrorCode::deviceLost;
    }
    return {code, what + ": " + resultName(result) + " (" + std::to_string(static_cast<int>(result)) + ")"};
}

Requirements requirements() {
    Requirements r;
    for (const NamedFeature12& feature : kFeatures12) {
        r.features12.*feature.member = VK_TRUE;
    }
    for (const NamedFeature13& feature : kFeatures13) {
        r.features13.*feature.member = VK_TRUE;
    }
    return r;
}

std::string missingInInstance(VkInstance instance, VkPhysicalDevice physicalDevice,
                              PFN_vkGetInstanceProcAddr getInstanceProcAddr, uint32_t instanceVersion) {
    if (instanceVersion != 0 && instanceVersion < VK_API_VERSION_1_3) {
        return std::string(kNewInstance) + ": this one has " + versionText(instanceVersion);
    }
    Functions vk;
    if (const char* missing = vk.loadInstance(instance, getInstanceProcAddr)) {
        return std::string(kNewInstance) + ": this one has no " + missing;
    }
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    vk.GetPhysicalDeviceProperties2(physicalDevice, &properties);
    if (properties.properties.apiVersion >= VK_API_VERSION_1_3 && OfferedFeatures(vk, physicalDevice).untouched) {
        return std::string(kNewInstance) + ": this one has 1.0";
    }
    return {};
}

std::string missingRequirement(VkInstance instance, VkPhysicalDevice physicalDevice,
                               PFN_vkGetInstanceProcAddr getInstanceProcAddr) {
    Functions vk;
    vk.loadInstance(instance, getInstanceProcAddr);
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    vk.GetPhysicalDeviceProperties2(physicalDevice, &properties);
    if (properties.properties.apiVersion < VK_API_VERSION_1_3) {
        return "Vulkan 1.3 (it offers " + versionText(properties.properties.apiVersion) + ")";
    }
    const OfferedFeatures offered(vk, physicalDevice);
    for (const NamedFeature12& feature : kFeatures12) {
        if (offered.features12.*feature.member != VK_TRUE) {
            return std::string("feature ") + feature.name;
        }
    }
    for (const NamedFeature13& feature : kFeatures13) {
        if (offered.features13.*feature.member != VK_TRUE) {
            return std::string("feature ") + feature.name;
        }
    }

    const VkPhysicalDeviceLimits& limits = properties.properties.limits;
    if (std::min(limits.maxPerStageDescriptorStorageBuffers, limits.maxDescriptorSetStorageBuffers) <
        kMaxStorageBuffers) {
        return std::string("limit maxPerStageDescriptorStorageBuffers of ") + std::to_string(kMaxStorageBuffers);
    }
    if (std::min(limits.maxPerStageDescriptorSampledImages, limits.maxDescriptorSetSampledImages) < kMaxTexelBuffers) {
        return "limit maxPerStageDescriptorSampledImages of " + std::to_string(kMaxTexelBuffers);
    }
    if (limits.maxPushConstantsSize < kPushConstantBytes) {
        return "limit maxPushConstantsSize of " + std::to_string(kPushConstantBytes);
    }

    for (VkFormat format : {VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32_UINT}) {
        VkFormatProperties formatProperties;
        vk.GetPhysicalDeviceFormatProperties(physicalDevice, format, &formatProperties);
        if ((formatProperties.bufferFeatures & VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT) == 0) {
            return "uniform texel buffers of 32-bit formats";
        }
    }
    return {};
}

std::string disabledFeature(const void* chain) {
    VkPhysicalDeviceVulkan12Features enabled12{};
    VkPhysicalDeviceVulkan13Features enabled13{};
    for (const auto* next = static_cast<const VkBaseInStructure*>(chain); next != nullptr; next = next->pNext) {
        switch (next->sType) {
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES:
            enabled12 = *reinterpret_cast<const VkPhysicalDeviceVulkan12Features*>(next);
            break;
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES:
            enabled13 = *reinterpret_cast<const VkPhysicalDeviceVulkan13Features*>(next);
            break;
        // What came into the core versions may be enabled one by one instead.
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES:
            enabled12.scalarBlockLayout =
                reinterpret_cast<const VkPhysicalDeviceScalarBlockLayoutFeatures*>(next)->scalarBlockLayout;
            break;
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES:
            enabled13.synchronization2 =
                reinterpret_cast<const VkPhysicalDeviceSynchronization2Features*>(next)->synchronization2;
            break;
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES:
            enabled13.maintenance4 = reinterpret_cast<const VkPhysicalDeviceMaintenance4Features*>(next)->maintenance4;
            break;
        default:
            break;
        }
    }
    for (const NamedFeature12& feature : kFeatures12) {
        if (enabled12.*feature.member == VK_FALSE) {
            return feature.name;
        }
    }
    for (const NamedFeature13& feature : kFeatures13) {
        if (enabled13.*feature.member == VK_FALSE) {
            return feature.name;
        }
    }
    return {};
}

bool enablesAddresses(const void* chain) {
    bool enabled = false;
    for (const auto* next = static_cast<const VkBaseInStructure*>(chain); next != nullptr; next = next->pNext) {
        if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES) {
            const auto& own = *reinterpret_cast<const VkPhysicalDeviceVulkan12Features*>(next);
            enabled = enabled || own.bufferDeviceAddress == VK_TRUE;
        } else if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES) {
            const auto& own = *reinterpret_cast<const VkPhysicalDeviceBufferDeviceAddressFeatures*>(next);
            enabled = enabled || own.bufferDeviceAddress == VK_TRUE;
        }
    }
    return enabled;
}

bool hasIndirectFirstInstance(const Functions& vk, VkPhysicalDevice physicalDevice, const void* chain) {
    VkPhysicalDeviceFeatures2 offered{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    vk.GetPhysicalDeviceFeatures2(physicalDevice, &offered);
    bool enabled = offered.features.drawIndirectFirstInstance == VK_TRUE;
    for (const auto* next = static_cast<const VkBaseInStructure*>(chain); next != nullptr; next = next->pNext) {
        if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2) {
            const auto& own = reinterpret_cast<const VkPhysicalDeviceFeatures2*>(next)->features;
            enabled = enabled && own.drawIndirectFirstInstance == VK_TRUE;
        }
    }
    return enabled;
}

namespace {

Status checkRayTracing(const DeviceDesc& desc) {
    const std::string missing = missingForRayTracing(desc.instance, desc.physicalDevice, desc.getInstanceProcAddr);
    if (!missing.empty()) {
        return Error{ErrorCode::unsupported, "ray tracing: the device lacks the " + missing};
    }
    const std::string disabled = desc.enabledFeatures != nullptr ? disabledForRayTracing(desc.enabledFeatures) : "";
    if (!disabled.empty()) {
        return Error{ErrorCode::disabled, "ray tracing: the device was created without the feature " + disabled};
    }
    return success();
}

/// Whether the host's instance and device have what is needed.
Status checkFit(const DeviceDesc& desc) {
    const std::string tooOld = missingInInstance(desc.instance, desc.physicalDevice, desc.getInstanceProcAddr, 0);
    if (!tooOld.empty()) {
        return Error{ErrorCode::unsupported, tooOld};
    }
    const std::string missing = missingRequirement(desc.instance, desc.physicalDevice, desc.getInstanceProcAddr);
    if (!missing.empty()) {
        return Error{ErrorCode::unsupported, "the device lacks " + missing};
    }
    const std::string disabled = desc.enabledFeatures != nullptr ? disabledFeature(desc.enabledFeatures) : "";
    if (!disabled.empty()) {
        return Error{ErrorCode::disabled, "the device was created without the feature " + disabled};
    }
    return desc.rayTracing ? checkRayTracing(desc) : success();
}

/// Whether the queues are of families that the device has, and can do what is asked of them.
Status readFamilies(const DeviceDesc& desc, Device& d) {
    uint32_t familyCount = 0;
    d.vk.GetPhysicalDeviceQueueFamilyProperties(desc.physicalDevice, &familyCount, nullptr);
    for (const uint32_t family : {desc.queueFamily, desc.drawQueueFamily}) {
        if (family >= familyCount) {
            return Error{ErrorCode::range,
                         "queue family " + std::to_string(family) + ": the device has " + std::to_string(familyCount)};
        }
    }
    std::vector<VkQueueFamilyProperties> families(familyCount);
    d.vk.GetPhysicalDeviceQueueFamilyProperties(desc.physicalDevice, &familyCount, families.data());
    if ((families[desc.queueFamily].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) {
        return Error{ErrorCode::argument, "queue family " + std::to_string(desc.queueFamily) + ": no compute"};
    }
    d.timestampValidBits = families[desc.queueFamily].timestampValidBits;
    return success();
}

} // namespace

Result<Device> Device::create(const DeviceDesc& desc) {
    if (Status fit = checkFit(desc); !fit) {
        return fit.error();
    }
    Device d;
    d.physicalDevice = desc.physicalDevice;
    d.handle = desc.device;
    d.pipelineCache = desc.pipelineCache;
    d.allocator = desc.allocator;
    d.memorySource = desc.memorySource;
    d.memoryBlockSize = desc.memoryBlockSize;
    d.debugUtils = desc.debugUtils;
    d.rayTracing = desc.rayTracing;
    d.vk.loadInstance(desc.instance, desc.getInstanceProcAddr);
    if (const char* name = d.vk.loadDevice(desc.instance, desc.device, desc.getInstanceProcAddr, desc.debugUtils)) {
        const std::string text = std::string("the device gives no ") + name;
        // Loaders and drivers hand out what the instance's version has. Only these functions are newer than 1.1.
        constexpr std::array<std::string_view, 3> kNewer{"vkGetBufferDeviceAddress", "vkCmdPipelineBarrier2",
                                                         "vkCmdWriteTimestamp2"};
        const bool isNew = std::find(kNewer.begin(), kNewer.end(), name) != kNewer.end();
        return Error{ErrorCode::unsupported, isNew ? text + ": " + kNewInstance : text};
    }

    VkPhysicalDeviceMaintenance3Properties maintenance3{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
    VkPhysicalDeviceMaintenance4Properties maintenance4{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES};
    maintenance4.pNext = &maintenance3;
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    driver.pNext = &maintenance4;
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    properties.pNext = &driver;
    d.vk.GetPhysicalDeviceProperties2(desc.physicalDevice, &properties);
    d.limits = properties.properties.limits;
    d.maxBufferSize = maintenance4.maxBufferSize;
    d.maxAllocationSize = maintenance3.maxMemoryAllocationSize;
    d.mapping = chooseMapping(properties.properties.deviceType, driver.driverID, desc.mapping);
    d.mapping.fanRecords = desc.fanRecords;
    d.mapping.sharesDispatches = d.mapping.wide && desc.shareDispatches;
    if (d.mapping.sharesDispatches && desc.enabledFeatures != nullptr && !enablesAddresses(desc.enabledFeatures)) {
        return Error{ErrorCode::disabled,
                     "shared dispatches: the device was created without the feature bufferDeviceAddress"};
    }
    d.vk.GetPhysicalDeviceMemoryProperties(desc.physicalDevice, &d.memory);
    d.fastMath = hasFastMath(d.vk, desc.physicalDevice);
    d.drawIndirectFirstInstance = hasIndirectFirstInstance(d.vk, desc.physicalDevice, desc.enabledFeatures);
    if (Status families = readFamilies(desc, d); !families) {
        return families.error();
    }
    return d;
}

void Device::setName(VkObjectType type, uint64_t object, const char* name) const {
    if (!debugUtils) {
        return;
    }
    VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
    info.objectType = type;
    info.objectHandle = object;
    info.pObjectName = name;
    vk.SetDebugUtilsObjectNameEXT(handle, &info);
}

void Device::beginLabel(VkCommandBuffer commandBuffer, const char* name) const {
    if (!debugUtils) {
        return;
    }
    VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
    label.pLabelName = name;
    vk.CmdBeginDebugUtilsLabelEXT(commandBuffer, &label);
}

void Device::endLabel(VkCommandBuffer commandBuffer) const {
    if (debugUtils) {
        vk.CmdEndDebugUtilsLabelEXT(commandBuffer);
    }
}

VkDeviceSize Device::bufferWindow(uint32_t texelBytes) const {
    const VkDeviceSize texels = static_cast<VkDeviceSize>(limits.maxTexelBufferElements) * texelBytes;
    // The wide mapping reads no texels: its views may be shorter than the buffer.
    return mapping.wide ? limits.maxStorageBufferRange : std::min<VkDeviceSize>(limits.maxStorageBufferRange, texels);
}

void memoryBarrier(const Device& device, VkCommandBuffer commandBuffer, SyncScope before, SyncScope after) {
    VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    barrier.srcStageMask = before.stages;
    barrier.srcAccessMask = before.access;
    barrier.dstStageMask = after.stages;
    barrier.dstAccessMask = after.access;
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &barrier;
    device.vk.CmdPipelineBarrier2(commandBuffer, &dependency);
}

VkBufferMemoryBarrier2 bufferBarrier(VkBuffer buffer) {
    VkBufferMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2};
    barrier.buffer = buffer;
    barrier.size = VK_WHOLE_SIZE;
    return barrier;
}

void computeBarrier(const Device& device, VkCommandBuffer commandBuffer) {
    constexpr VkAccessFlags2 kRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    constexpr VkAccessFlags2 kWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    memoryBarrier(device, commandBuffer, {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, kWrite},
                  {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, kRead | kWrite});
}

void disjointBarrier(const Device& device, VkCommandBuffer commandBuffer) {
    if (!device.mapping.wide) {
        computeBarrier(device, commandBuffer);
    }
}

} // namespace supple::gpu
