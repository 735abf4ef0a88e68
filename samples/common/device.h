// The dull part of a Vulkan program, for the samples that draw: instance, device, buffers, images, and frames in
// flight. What Supple has a say in: requirements() and the chain enabledFeatures().
#pragma once

#include <supple/supple.hpp>

#include <vulkan/vulkan.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace sample {

/// A sample may stop at the first failure: the process ends and takes everything with it.
[[noreturn]] void fail(const std::string& what, int exitCode = 1);
void check(VkResult result, const char* what);
void check(SuppleResult result, const char* what);

/// Whether SUPPLE_VALIDATION=1 is in the environment.
bool validationWanted();
/// Messages of the validation layer so far.
int validationMessages();

struct DeviceOptions {
    const char* name = "supple sample";
    std::vector<const char*> instanceExtensions;
    std::function<VkSurfaceKHR(VkInstance)> createSurface; ///< empty: nothing is presented
};

class Device {
public:
    explicit Device(const DeviceOptions& options);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    VkInstance instance() const { return instance_; }
    VkPhysicalDevice physicalDevice() const { return physicalDevice_; }
    VkDevice handle() const { return device_; }
    uint32_t queueFamily() const { return queueFamily_; }
    VkQueue queue() const { return queue_; }
    VkSurfaceKHR surface() const { return surface_; }
    const VkPhysicalDeviceProperties& properties() const { return properties_; }
    /// What vkCreateDevice was given, for SuppleContextDesc.enabledFeatures.
    const void* enabledFeatures() const { return &requirements_.features12; }

    uint32_t memoryType(uint32_t bits, VkMemoryPropertyFlags wanted) const;
    /// Runs when the device goes, the last first; for what lives as long.
    void atEnd(std::function<void()> destroy) { atEnd_.push_back(std::move(destroy)); }
    void waitIdle() const { vkDeviceWaitIdle(device_); }

private:
    void createInstance(const DeviceOptions& options);
    void choosePhysicalDevice();
    void createDevice();

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice_ = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties_{};
    SuppleRequirements requirements_{};
    uint32_t queueFamily_ = 0;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::vector<std::function<void()>> atEnd_;
};

/// A buffer with memory of its own; samples/c_host shows one that shares blocks.
class Buffer {
public:
    Buffer() = default;
    /// hostVisible: mapped for as long as it lives.
    Buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, bool hostVisible);
    Buffer(Buffer&& other) noexcept { *this = std::move(other); }
    Buffer& operator=(Buffer&& other) noexcept;
    ~Buffer();

    VkBuffer handle() const { return buffer_; }
    VkDeviceSize size() const { return size_; }
    void* mapped() const { return mapped_; }

private:
    VkDevice device_ = VK_NULL_HANDLE;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkDeviceSize size_ = 0;
    void* mapped_ = nullptr;
};

struct ImageDesc {
    VkExtent2D extent{};
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkImageUsageFlags usage = 0;
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    uint32_t mipLevels = 1;
};

class Image {
public:
    Image() = default;
    Image(const Device& device, const ImageDesc& desc);
    Image(Image&& other) noexcept { *this = std::move(other); }
    Image& operator=(Image&& other) noexcept;
    ~Image();

    VkImage handle() const { return image_; }
    VkImageView view() const { return view_; }
    const ImageDesc& desc() const { return desc_; }

private:
    VkDevice device_ = VK_NULL_HANDLE;
    VkImage image_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
    ImageDesc desc_;
};

inline constexpr uint64_t kFramesInFlight = 2;

/// Command buffers in flight. A timeline semaphore counts the finished frames, which is just what suppleBeginFrame
/// asks.
class Frames {
public:
    explicit Frames(const Device& device);
    ~Frames();
    Frames(const Frames&) = delete;
    Frames& operator=(const Frames&) = delete;

    /// Waits until there is room for another frame.
    void waitForRoom() const;
    /// Begins the next frame's command buffer, when there is room.
    VkCommandBuffer begin();
    /// acquired, drawn: of the swapchain, or null. The commands wait for `acquired` from `acquiredStages` on.
    void submit(VkSemaphore acquired = VK_NULL_HANDLE, VkPipelineStageFlags2 acquiredStages = 0,
                VkSemaphore drawn = VK_NULL_HANDLE);
    /// The number of the frame that was begun last, from 1.
    uint64_t frame() const { return frame_; }
    /// The last frame that is complete.
    uint64_t completed() const;
    /// Which of the resources that exist once a frame in flight.
    uint32_t slot() const { return static_cast<uint32_t>(frame_ % kFramesInFlight); }
    uint32_t nextSlot() const { return static_cast<uint32_t>((frame_ + 1) % kFramesInFlight); }

private:
    const Device& device_;
    VkSemaphore timeline_ = VK_NULL_HANDLE;
    VkCommandPool pools_[kFramesInFlight]{};
    VkCommandBuffer commands_[kFramesInFlight]{};
    uint64_t frame_ = 0;
};

} // namespace sample
