// The images of a window, which a host copies its pictures into. Survives resizing and minimising.
#pragma once

#include "host/frames.h"

#include <array>
#include <memory>
#include <vector>

namespace supple::host {

class Swapchain {
public:
    /// Takes over the surface, also if it fails. The device must have been created with DeviceOptions::window and must
    /// outlive the swapchain. ErrorCode::unsupported if the device cannot show 8-bit pictures on the surface.
    [[nodiscard]] static Result<std::unique_ptr<Swapchain>> create(Device& device, VkSurfaceKHR surface);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    /// Makes the images anew, in the window's size; waits for the device. `drawable`: the size if the surface leaves it
    /// to the swapchain. False while the window has no size.
    [[nodiscard]] Result<bool> resize(VkExtent2D drawable);
    [[nodiscard]] VkExtent2D extent() const { return extent_; }
    /// 8 bits, UNORM: sRGB values are written as they are.
    [[nodiscard]] VkFormat format() const { return format_.format; }
    [[nodiscard]] VkImage image(uint32_t index) const { return images_[index]; }
    [[nodiscard]] const std::vector<VkImageView>& views() const { return views_; }
    /// Changes whenever the images do.
    [[nodiscard]] uint32_t generation() const { return generation_; }
    /// Images can be read back.
    [[nodiscard]] bool canRead() const { return canRead_; }

    /// Waits for an image. False: the swapchain must be resized.
    [[nodiscard]] Result<bool> acquire(uint32_t slot);
    /// Of the image that was acquired last.
    [[nodiscard]] uint32_t index() const { return index_; }
    /// The frame waits for `acquired` and signals `drawn`.
    [[nodiscard]] VkSemaphore acquired(uint32_t slot) const { return acquired_[slot]; }
    [[nodiscard]] VkSemaphore drawn() const { return drawn_[index_]; }
    /// Where `acquired` must have been waited for: pictures are copied.
    static constexpr VkPipelineStageFlags2 kFirstUse = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    /// Shows the image, which must be in PRESENT_SRC_KHR by then. False: the swapchain must be resized.
    [[nodiscard]] Result<bool> present();

private:
    Swapchain(Device& device, VkSurfaceKHR surface) : device_(device), surface_(surface) {}
    [[nodiscard]] Status chooseFormat();
    [[nodiscard]] Status createSwapchain(const VkSurfaceCapabilitiesKHR& surface, VkExtent2D extent);
    [[nodiscard]] Status createViews();
    void destroyViews();

    Device& device_;
    VkSurfaceKHR surface_;
    VkSurfaceFormatKHR format_{};
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
    bool canRead_ = false;
    uint32_t generation_ = 0;
    std::vector<VkImage> images_;
    std::vector<VkImageView> views_;
    std::vector<VkSemaphore> drawn_; ///< one per image
    std::array<VkSemaphore, kFramesInFlight> acquired_{};
    uint32_t index_ = 0;
};

} // namespace supple::host
