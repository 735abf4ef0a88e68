// A window, its swapchain, and the ring of frames drawn into it. Survives resizing and minimising.
#pragma once

#include "host/device.h"
#include "host/picture.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct GLFWwindow;

namespace supple::host {

inline constexpr uint32_t kWindowFramesInFlight = 2;

/// One frame being recorded.
struct WindowFrame {
    VkCommandBuffer commands = VK_NULL_HANDLE;
    uint32_t slot = 0;  ///< 0..kWindowFramesInFlight - 1: what the frame owns by slot is free
    uint32_t image = 0; ///< of the swapchain
};

class Window {
public:
    /// The device must have been created with DeviceOptions::window and must outlive the window. ErrorCode::unsupported
    /// without a display.
    [[nodiscard]] static Result<std::unique_ptr<Window>> create(Device& device, const std::string& title,
                                                                VkExtent2D size);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    [[nodiscard]] GLFWwindow* handle() const { return window_; }
    [[nodiscard]] bool shouldClose() const;
    /// Of the swapchain's images.
    [[nodiscard]] VkExtent2D extent() const { return extent_; }
    /// 8 bits, UNORM: sRGB values are written as they are.
    [[nodiscard]] VkFormat format() const { return format_; }
    [[nodiscard]] VkImage image(uint32_t index) const { return images_[index]; }
    [[nodiscard]] const std::vector<VkImageView>& views() const { return views_; }
    /// Changes whenever the swapchain's images do.
    [[nodiscard]] uint32_t generation() const { return generation_; }
    /// Swapchain images can be read back.
    [[nodiscard]] bool canRead() const { return canRead_; }

    /// Handles events and waits for the slot's last frame. No frame: the window is minimised or was just rebuilt; try
    /// again. The frame's commands are begun.
    [[nodiscard]] Result<std::optional<WindowFrame>> begin();
    /// Ends the commands, which must leave the image in PRESENT_SRC_KHR and touch it first in a transfer; submits and
    /// presents. `number` is this frame's, remembered for completedFrame().
    [[nodiscard]] Status end(const WindowFrame& frame, uint64_t number);
    /// The newest frame number whose commands are known to have finished.
    [[nodiscard]] uint64_t completedFrame() const { return completedFrame_; }
    /// Waits for everything; `number` is the newest frame number given out.
    void waitIdle(uint64_t number);

private:
    struct Slot {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkFence done = VK_NULL_HANDLE;
        VkSemaphore acquired = VK_NULL_HANDLE;
        uint64_t number = 0;
    };

    explicit Window(Device& device) : device_(device) {}
    [[nodiscard]] Status open(const std::string& title, VkExtent2D size);
    [[nodiscard]] Status chooseFormat();
    [[nodiscard]] Status createSlots();
    /// Success without a swapchain while the window has no size.
    [[nodiscard]] VkExtent2D drawableExtent(const VkSurfaceCapabilitiesKHR& surface) const;
    [[nodiscard]] Status createSwapchain();
    [[nodiscard]] Status createSwapchainViews();
    void destroySwapchainViews();

    Device& device_;
    GLFWwindow* window_ = nullptr;
    bool glfwReady_ = false;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkFormat format_ = VK_FORMAT_UNDEFINED;
    VkColorSpaceKHR colorSpace_ = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
    VkExtent2D extent_{};
    bool canRead_ = false;
    bool stale_ = true; ///< the swapchain no longer fits the window
    uint32_t generation_ = 0;
    std::vector<VkImage> images_;
    std::vector<VkImageView> views_;
    std::vector<VkSemaphore> drawn_; ///< one an image: presenting waits for it
    std::array<Slot, kWindowFramesInFlight> slots_;
    uint32_t slot_ = 0;
    uint64_t completedFrame_ = 0;
};

} // namespace supple::host
