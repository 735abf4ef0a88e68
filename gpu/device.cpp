#include "gpu/device.h"

#include "gpu/fast_math.h"
#include "gpu/ray_tracing.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace supple::gpu {

namespace {

constexpr const char* kNewInstance = "the VkInstance must be created with apiVersion 1.1 or more";

std::string versionText(uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version));
}

/// What newer structs say of a device. Of those that its version lacks, the members stay as they are here.
struct Properties {
    VkPhysicalDeviceMaintenance3Properties maintenance3{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceMaintenance4Properties maintenance4{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES};
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};

    Properties(const Functions& vk, VkPhysicalDevice physicalDevice) {
        vk.GetPhysicalDeviceProperties2(physicalDevice, &all);
        maintenance4.maxBufferSize = std::numeric_limits<VkDeviceSize>::max();
        const uint32_t version = all.properties.apiVersion;
        const auto chain = [&](uint32_t since, auto& properties) {
            if (version >= since) {
                properties.pNext = all.pNext;
                all.pNext = &properties;
            }
        };
        chain(VK_API_VERSION_1_1, maintenance3);
        chain(VK_API_VERSION_1_2, driver);
        chain(VK_API_VERSION_1_3, maintenance4);
        vk.GetPhysicalDeviceProperties2(physicalDevice, &all);
    }
    Properties(const Properties&) = delete;
    Properties& operator=(const Properties&) = delete;

    [[nodiscard]] uint32_t version() const { return all.properties.apiVersion; }
    /// Loaders answer for an instance of Vulkan 1.0 themselves, and know no structs of later versions.
    [[nodiscard]] bool isOfOldInstance() const {
        return version() >= VK_API_VERSION_1_1 && maintenance3.maxMemoryAllocationSize == 0;
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

std::string missingInInstance(VkInstance instance, VkPhysicalDevice physicalDevice,
                              PFN_vkGetInstanceProcAddr getInstanceProcAddr, uint32_t instanceVersion) {
    if (instanceVersion != 0 && instanceVersion < kVulkanVersion) {
        return std::string(kNewInstance) + ": this one has " + versionText(instanceVersion);
    }
    Functions vk;
    if (const char* missing = vk.loadInstance(instance, getInstanceProcAddr)) {
        return std::string(kNewInstance) + ": this one has no " + missing;
    }
    return Properties(vk, physicalDevice).isOfOldInstance() ? std::string(kNewInstance) + ": this one has 1.0" : "";
}

std::string missingRequirement(VkInstance instance, VkPhysicalDevice physicalDevice,
                               PFN_vkGetInstanceProcAddr getInstanceProcAddr) {
    Functions vk;
    vk.loadInstance(instance, getInstanceProcAddr);
    const Properties properties(vk, physicalDevice);
    if (properties.version() < kVulkanVersion) {
        return "Vulkan 1.1 (it offers " + versionText(properties.version()) + ")";
    }
    const VkPhysicalDeviceLimits& limits = properties.all.properties.limits;
    if (std::min(limits.maxPerStageDescriptorStorageBuffers, limits.maxDescriptorSetStorageBuffers) <
        kMaxStorageBuffers) {
        return std::string("limit maxPerStageDescriptorStorageBuffers of ") + std::to_string(kMaxStorageBuffers);
    }
    if (limits.maxPushConstantsSize < kPushConstantBytes) {
        return "limit maxPushConstantsSize of " + std::to_string(kPushConstantBytes);
    }
    return {};
}

std::string missingForAddresses(VkInstance instance, VkPhysicalDevice physicalDevice,
                                PFN_vkGetInstanceProcAddr getInstanceProcAddr) {
    Functions vk;
    vk.loadInstance(instance, getInstanceProcAddr);
    const uint32_t version = Properties(vk, physicalDevice).version();
    if (version < VK_API_VERSION_1_2) {
        return "Vulkan 1.2 (it offers " + versionText(version) + ")";
    }
    VkPhysicalDeviceBufferDeviceAddressFeatures addresses{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES};
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    features.pNext = &addresses;
    vk.GetPhysicalDeviceFeatures2(physicalDevice, &features);
    return addresses.bufferDeviceAddress == VK_TRUE ? "" : "feature bufferDeviceAddress";
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
        return Error{ErrorCode::unsupported, "ray tracing: the device lacks " + missing};
    }
    const std::string disabled = desc.enabledFeatures != nullptr ? disabledForRayTracing(desc.enabledFeatures) : "";
    if (!disabled.empty()) {
        return Error{ErrorCode::disabled, "ray tracing: the device was created without the feature " + disabled};
    }
    return success();
}

Status checkSharedDispatches(const DeviceDesc& desc) {
    const std::string missing = missingForAddresses(desc.instance, desc.physicalDevice, desc.getInstanceProcAddr);
    if (!missing.empty()) {
        return Error{ErrorCode::unsupported, "shared dispatches: the device lacks " + missing};
    }
    if (desc.enabledFeatures != nullptr && !enablesAddresses(desc.enabledFeatures)) {
        return Error{ErrorCode::disabled,
                     "shared dispatches: the device was created without the feature bufferDeviceAddress"};
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
    return desc.rayTracing ? checkRayTracing(desc) : success();
}

/// What the narrow mapping lacks, or empty.
std::string missingForTexels(const Functions& vk, VkPhysicalDevice physicalDevice,
                             const VkPhysicalDeviceLimits& limits) {
    if (std::min(limits.maxPerStageDescriptorSampledImages, limits.maxDescriptorSetSampledImages) < kMaxTexelBuffers) {
        return "limit maxPerStageDescriptorSampledImages of " + std::to_string(kMaxTexelBuffers);
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

/// The mapping that fits the device, or the one that was asked for.
Result<Mapping> mappingOf(const DeviceDesc& desc, const Functions& vk, const Properties& properties) {
    const VkPhysicalDeviceLimits& limits = properties.all.properties.limits;
    const std::string missing = missingForTexels(vk, desc.physicalDevice, limits);
    if (!missing.empty() && desc.mapping == MappingChoice::narrow) {
        return Error{ErrorCode::unsupported, "the narrow mapping: the device lacks " + missing};
    }
    Mapping mapping = chooseMapping(properties.all.properties.deviceType, properties.driver.driverID,
                                    missing.empty() ? limits.maxTexelBufferElements : 0, desc.mapping);
    mapping.fanRecords = desc.fanRecords;
    mapping.sharesDispatches = mapping.wide && desc.shareDispatches;
    if (mapping.sharesDispatches) {
        if (Status fit = checkSharedDispatches(desc); !fit) {
            return fit.error();
        }
    }
    return mapping;
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
        return Error{ErrorCode::unsupported, std::string("the device gives no ") + name};
    }

    const Properties properties(d.vk, desc.physicalDevice);
    d.limits = properties.all.properties.limits;
    d.maxBufferSize = properties.maintenance4.maxBufferSize;
    d.maxAllocationSize = properties.maintenance3.maxMemoryAllocationSize;
    Result<Mapping> mapping = mappingOf(desc, d.vk, properties);
    if (!mapping) {
        return mapping.error();
    }
    d.mapping = *mapping;
    if (d.givesAddresses() && d.vk.GetBufferDeviceAddress == nullptr) {
        return Error{ErrorCode::unsupported,
                     "the device gives no vkGetBufferDeviceAddress: the VkInstance must be created with apiVersion 1.2 "
                     "or more"};
    }
    d.vk.GetPhysicalDeviceMemoryProperties(desc.physicalDevice, &d.memory);
    d.fastMath = properties.version() >= VK_API_VERSION_1_2 && hasFastMath(d.vk, desc.physicalDevice);
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

} // namespace supple::gpu
