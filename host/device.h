// The Vulkan objects of a host: instance, device, one queue, and the few helpers tools, samples and tests need round
// them. Supple borrows all this; no part of the library includes it.
#pragma once

#include "base/result.h"
#include "host/validation_log.h"

#include <supple/supple.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <vulkan/vulkan.h>

namespace supple::host {

struct DeviceOptions {
    /// Part of the device's name (any case) or its index; empty takes the best: discrete, integrated, virtual, CPU.
    std::string device = {};
    /// VK_LAYER_KHRONOS_validation with synchronization validation; its messages are counted and printed.
    bool validation = false;
    /// Surface and swapchain extensions too.
    bool window = false;
    /// Acceleration structures and ray queries, for SUPPLE_CONTEXT_RAY_TRACING and host/ray_scene.h. A device without
    /// them will not do.
    bool rayTracing = false;
    /// Mesh shaders, for GraphicsDesc::meshShader and drawMeshTasks(). A device without them will not do.
    bool meshShaders = false;
    /// Instance and device of Vulkan 1.1 without a feature, which is enough for Supple and not for what is drawn here.
    bool onlyCompute = false;
    /// What suppleCreateContext is given instead of the loader's: tests count Vulkan calls through a wrapped table.
    PFN_vkGetInstanceProcAddr suppleGetInstanceProcAddr = nullptr;
};

/// The device's clock and the host's (CLOCK_MONOTONIC, which is std::chrono::steady_clock's) at one moment.
struct ClockPair {
    uint64_t ticks = 0;     ///< of the device, VkPhysicalDeviceLimits::timestampPeriod nanoseconds each
    uint64_t host = 0;      ///< nanoseconds
    uint64_t deviation = 0; ///< nanoseconds; they were read no further apart
};

enum class MemoryKind {
    device,   ///< fastest for the device
    upload,   ///< mapped, written by the host
    readback, ///< mapped, read by the host
};

/// A buffer and its own memory. Moves; frees both when it goes.
class Buffer {
public:
    Buffer() = default;
    Buffer(Buffer&& other) noexcept { *this = std::move(other); }
    Buffer& operator=(Buffer&& other) noexcept;
    ~Buffer() { reset(); }
    void reset();

    [[nodiscard]] VkBuffer handle() const { return buffer_; }
    [[nodiscard]] VkDeviceSize size() const { return size_; }
    /// Null for MemoryKind::device.
    [[nodiscard]] void* mapped() const { return mapped_; }
    /// Only of a buffer created with VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT.
    [[nodiscard]] VkDeviceAddress address() const;

private:
    friend class Device;
    VkDevice device_ = VK_NULL_HANDLE;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkDeviceSize size_ = 0;
    void* mapped_ = nullptr;
};

struct ImageDesc {
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D extent{};
    VkImageUsageFlags usage = 0;
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    uint32_t mipLevels = 1;
    uint32_t layers = 1; ///< more than one makes the view a 2D array
};

/// A 2D image, its memory and a view of all of it. Moves; frees all three when it goes.
class Image {
public:
    Image() = default;
    Image(Image&& other) noexcept { *this = std::move(other); }
    Image& operator=(Image&& other) noexcept;
    ~Image() { reset(); }
    void reset();

    [[nodiscard]] VkImage handle() const { return image_; }
    [[nodiscard]] VkImageView view() const { return view_; }
    [[nodiscard]] const ImageDesc& desc() const { return desc_; }

private:
    friend class Device;
    VkDevice device_ = VK_NULL_HANDLE;
    VkImage image_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
    ImageDesc desc_;
};

/// Instance, device, one graphics + compute queue and a command pool. Used from one thread.
class Device {
public:
    /// ErrorCode::unsupported when no device will do, the named one is absent or lacks a feature, or the validation
    /// layer is missing: the tools' exit code 3.
    [[nodiscard]] static Result<std::unique_ptr<Device>> create(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] VkInstance instance() const { return instance_; }
    [[nodiscard]] VkPhysicalDevice physicalDevice() const { return physicalDevice_; }
    [[nodiscard]] VkDevice handle() const { return device_; }
    [[nodiscard]] VkQueue queue() const { return queue_; }
    [[nodiscard]] uint32_t queueFamily() const { return queueFamily_; }
    [[nodiscard]] VkCommandPool commandPool() const { return commandPool_; }
    [[nodiscard]] const VkPhysicalDeviceProperties& properties() const { return properties_; }
    [[nodiscard]] std::string name() const { return properties_.deviceName; }
    [[nodiscard]] bool isCpu() const { return properties_.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU; }
    [[nodiscard]] bool hasDebugUtils() const { return debugUtils_; }
    [[nodiscard]] bool tracesRays() const { return rayQuery_.rayQuery == VK_TRUE; }
    /// vkCmdDrawMeshTasksEXT; null without DeviceOptions::meshShaders.
    [[nodiscard]] PFN_vkCmdDrawMeshTasksEXT drawMeshTasks() const { return drawMeshTasks_; }
    [[nodiscard]] bool hasAnisotropy() const { return anisotropy_; }
    /// multiDrawIndirect and shaderDrawParameters: many draws by one call, whose shaders know the number of each.
    [[nodiscard]] bool drawsMany() const { return features_.features.multiDrawIndirect == VK_TRUE; }
    /// drawIndirectCount: as many as a buffer says.
    [[nodiscard]] bool countsDraws() const { return requirements_.features12.drawIndirectCount == VK_TRUE; }
    /// shaderStorageBufferArrayDynamicIndexing: a draw chooses its buffer from an array.
    [[nodiscard]] bool indexesBuffers() const {
        return features_.features.shaderStorageBufferArrayDynamicIndexing == VK_TRUE;
    }

    /// The chain that vkCreateDevice was given, for SuppleContextDesc::enabledFeatures.
    [[nodiscard]] const void* enabledFeatures() const { return &features_; }
    /// What suppleCreateContext is to be given: the option's function, or the loader's.
    [[nodiscard]] PFN_vkGetInstanceProcAddr getInstanceProcAddr() const { return getInstanceProcAddr_; }

    /// What the validation layer has said; nothing without validation. Outlives the device, so that what is said while
    /// the device is destroyed can be counted as well.
    [[nodiscard]] std::shared_ptr<const ValidationLog> validation() const { return validation_; }

    /// By VK_EXT_calibrated_timestamps; nothing where the device does not have it.
    [[nodiscard]] std::optional<ClockPair> readClocks() const;

    [[nodiscard]] Result<Buffer> createBuffer(VkDeviceSize size, VkBufferUsageFlags usage, MemoryKind kind);
    [[nodiscard]] Result<Image> createImage(const ImageDesc& desc);

    /// Runs when the device goes, the last one first: for what lives as long as the device.
    void atEnd(std::function<void()> destroy) { atEnd_.push_back(std::move(destroy)); }
    void waitIdle() const { vkDeviceWaitIdle(device_); }

    /// Records into a fresh command buffer, submits it and waits for it.
    [[nodiscard]] Status submitAndWait(const std::function<void(VkCommandBuffer)>& record);

    /// The bytes of a device buffer (TRANSFER_SRC) after all work submitted so far.
    [[nodiscard]] Result<std::vector<std::byte>> readBuffer(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size);
    [[nodiscard]] Result<std::vector<std::byte>> readBuffer(const SuppleBufferRange& view) {
        return readBuffer(view.buffer, view.offset, view.size);
    }
    /// A device buffer filled with the bytes; TRANSFER_DST is added to the usage.
    [[nodiscard]] Result<Buffer> uploadBuffer(const void* bytes, VkDeviceSize size, VkBufferUsageFlags usage);

    /// Names an object in validation messages and captures; does nothing without debug utils.
    void setName(VkObjectType type, uint64_t object, const char* name) const;

private:
    Device() = default;
    [[nodiscard]] Status createInstance(const DeviceOptions& options);
    [[nodiscard]] Status createMessenger();
    [[nodiscard]] Status choosePhysicalDevice(const DeviceOptions& options);
    /// What Supple asks for, and what the hosts' own drawing wants on top.
    void enableFeatures(const DeviceOptions& options);
    [[nodiscard]] Status createDevice(const DeviceOptions& options);
    /// Whether its clock can be read beside the host's.
    [[nodiscard]] bool readsClocks() const;
    [[nodiscard]] Status createCommands();
    [[nodiscard]] Result<VkDeviceMemory> allocate(const VkMemoryRequirements& requirements, MemoryKind kind,
                                                  bool addressed = false);

    std::shared_ptr<ValidationLog> validation_ = std::make_shared<ValidationLog>();
    PFN_vkGetInstanceProcAddr getInstanceProcAddr_ = nullptr;
    PFN_vkSetDebugUtilsObjectNameEXT setObjectName_ = nullptr;
    PFN_vkGetCalibratedTimestampsEXT getCalibratedTimestamps_ = nullptr;
    PFN_vkCmdDrawMeshTasksEXT drawMeshTasks_ = nullptr;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice_ = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties_{};
    VkPhysicalDeviceMemoryProperties memoryProperties_{};
    SuppleRequirements requirements_{}; ///< the features that are enabled
    VkPhysicalDeviceVulkan11Features features11_{};
    VkPhysicalDeviceRayQueryFeaturesKHR rayQuery_{};
    VkPhysicalDeviceMeshShaderFeaturesEXT meshShader_{};
    VkPhysicalDeviceFeatures2 features_{};
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    uint32_t queueFamily_ = 0;
    VkCommandPool commandPool_ = VK_NULL_HANDLE;
    /// Those of submitAndWait(). They are kept: the validation layer 1.3.239 drops what it knows of a freed command
    /// buffer on a thread of its own, perhaps after the next one has got the same handle, and reads freed memory then.
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    std::vector<std::function<void()>> atEnd_;
    bool debugUtils_ = false;
    bool anisotropy_ = false;
};

/// "vkCreateBuffer: VK_ERROR_OUT_OF_DEVICE_MEMORY", with the ErrorCode that fits the VkResult.
[[nodiscard]] Error vulkanError(VkResult result, std::string_view what);
[[nodiscard]] const char* vulkanResultName(VkResult result);

/// A global memory barrier; synchronization2 scopes.
void memoryBarrier(VkCommandBuffer commands, SuppleSyncScope before, SuppleSyncScope after);

struct ImageUse {
    VkImageLayout layout;
    SuppleSyncScope scope;
};
void imageBarrier(VkCommandBuffer commands, const Image& image, ImageUse before, ImageUse after);
void imageBarrier(VkCommandBuffer commands, VkImage image, const VkImageSubresourceRange& range, ImageUse before,
                  ImageUse after);

} // namespace supple::host
