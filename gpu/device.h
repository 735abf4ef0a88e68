// The borrowed device: handles, limits, the mapping, and the few helpers every pass needs. Owns nothing of the host's.
#pragma once

#include "base/result.h"
#include "gpu/functions.h"
#include "gpu/host_memory.h"
#include "gpu/mapping.h"
#include "gpu/memory_blocks.h"
#include "gpu/memory_use.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vulkan/vulkan_core.h>

namespace supple::gpu {

/// What a pass may push: as much as every Vulkan device takes.
inline constexpr uint32_t kPushConstantBytes = 128;
/// What a pass may bind; the requirements name it, and ComputeLayout::create holds the passes to it.
inline constexpr uint32_t kMaxStorageBuffers = 8;
inline constexpr uint32_t kMaxTexelBuffers = 6;

struct DeviceDesc {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    uint32_t queueFamily = 0;
    uint32_t drawQueueFamily = 0; ///< as queueFamily where nothing is handed over
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    VkPipelineCache pipelineCache = VK_NULL_HANDLE;
    const VkAllocationCallbacks* allocator = nullptr;
    const void* enabledFeatures = nullptr; ///< the chain the device was created with; null: taken on trust
    MemorySource memorySource;             ///< empty: vkAllocateMemory
    VkDeviceSize memoryBlockSize = 0;      ///< of the largest block; pieces of more than half of it have their own
    bool debugUtils = false;
    MappingChoice mapping = MappingChoice::automatic;
    bool shareDispatches = false; ///< in the wide mapping
    bool fanRecords = false;      ///< Mapping::fanRecords
    bool rayTracing = false;      ///< hosts build acceleration structures from buffers
};

class Uploads;

/// Everything here is constant after create(); usable from any thread.
struct Device {
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice handle = VK_NULL_HANDLE;
    VkPipelineCache pipelineCache = VK_NULL_HANDLE;
    const VkAllocationCallbacks* allocator = nullptr;
    MemorySource memorySource;
    VkDeviceSize memoryBlockSize = 0;
    std::shared_ptr<MemoryLedger> ledger = std::make_shared<MemoryLedger>(); ///< what it counts does change
    std::shared_ptr<MemoryBlocks> blocks = std::make_shared<MemoryBlocks>(); ///< and so do these
    /// Set behind create(): the budget of static data, of which the same is true. Null: there is no bound.
    Uploads* uploads = nullptr;
    bool debugUtils = false;
    Functions vk;
    Mapping mapping;
    VkPhysicalDeviceLimits limits{};
    VkDeviceSize maxBufferSize = 0;     ///< VkPhysicalDeviceMaintenance4Properties; no bound before 1.3
    VkDeviceSize maxAllocationSize = 0; ///< VkPhysicalDeviceMaintenance3Properties
    VkPhysicalDeviceMemoryProperties memory{};
    uint32_t timestampValidBits = 0;
    /// Indirect commands may name a first instance. True too if the host has not told what it enabled.
    bool drawIndirectFirstInstance = true;
    bool fastMath = false;   ///< gpu/fast_math.h
    bool rayTracing = false; ///< buffers may have gpu::kBuildInputUsage (gpu/ray_tracing.h)

    /// Whether buffers may have addresses: all memory is then allocated for them.
    [[nodiscard]] bool givesAddresses() const { return rayTracing || mapping.sharesDispatches; }

    [[nodiscard]] static Result<Device> create(const DeviceDesc& desc);

    /// Names an object for debuggers; nothing when debug utils are off.
    void setName(VkObjectType type, uint64_t object, const char* name) const;
    void beginLabel(VkCommandBuffer commandBuffer, const char* name) const;
    void endLabel(VkCommandBuffer commandBuffer) const;

    /// Device memory a storage-buffer descriptor and a texel view of `texelBytes` can both see.
    [[nodiscard]] VkDeviceSize bufferWindow(uint32_t texelBytes) const;
};

/// What instance and device must have. No feature and no extension is needed.
inline constexpr uint32_t kVulkanVersion = VK_API_VERSION_1_1;
/// What speaks against the instance, in a sentence; or empty. `instanceVersion`: what it was created with; 0: not
/// known. Then an instance of Vulkan 1.0 is found out by what it leaves untouched.
[[nodiscard]] std::string missingInInstance(VkInstance instance, VkPhysicalDevice physicalDevice,
                                            PFN_vkGetInstanceProcAddr getInstanceProcAddr, uint32_t instanceVersion);
/// The first thing `physicalDevice` lacks, or empty. The instance is fit.
[[nodiscard]] std::string missingRequirement(VkInstance instance, VkPhysicalDevice physicalDevice,
                                             PFN_vkGetInstanceProcAddr getInstanceProcAddr);

/// The same of buffers that have addresses.
[[nodiscard]] std::string missingForAddresses(VkInstance instance, VkPhysicalDevice physicalDevice,
                                              PFN_vkGetInstanceProcAddr getInstanceProcAddr);

/// Whether a chain given to vkCreateDevice (VkDeviceCreateInfo::pNext) enables bufferDeviceAddress.
[[nodiscard]] bool enablesAddresses(const void* chain);

/// Whether the feature drawIndirectFirstInstance is there, and enabled as far as the chain tells: it may be enabled by
/// VkDeviceCreateInfo::pEnabledFeatures instead.
[[nodiscard]] bool hasIndirectFirstInstance(const Functions& vk, VkPhysicalDevice physicalDevice, const void* chain);

/// An error from a VkResult: "what: VK_ERROR_...".
[[nodiscard]] Error vulkanError(VkResult result, const std::string& what);

} // namespace supple::gpu
