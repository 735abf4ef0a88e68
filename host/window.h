// A GLFW window, its swapchain, and the ring of frames drawn into it.
#pragma once

#include "host/swapchain.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

struct GLFWwindow;

namespace supple::host {

/// One frame being recorded.
struct WindowFrame {
    VkCommandBuffer commands = VK_NULL_HANDLE;
    uint32_t slot = 0;  ///< 0..kFramesInFlight - 1: what the frame owns by slot is free
    uint32_t image = 0; ///< of the swapchain
};

struct KeyPress {
    int key = 0;
    int modifiers = 0; ///< GLFW_MOD_...
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
    /// What there is to draw into; the window resizes it.
    [[nodiscard]] const Swapchain& swapchain() const { return *swapchain_; }

    /// Handles events, for the first of which it waits `patience` seconds at most, and waits for the slot's last frame.
    /// No frame: the window is minimised or was just rebuilt; try again. The frame's commands are begun.
    [[nodiscard]] Result<std::optional<WindowFrame>> begin(double patience = 0.0);
    /// To the clipboard.
    void copyText(const std::string& text);
    /// Keys (GLFW's numbers) that went down since it was asked last, however shortly.
    [[nodiscard]] std::vector<KeyPress> takeKeys() { return std::exchange(keys_, {}); }
    /// Paths of files that were dropped on the window since it was asked last.
    [[nodiscard]] std::vector<std::string> takeDropped() { return std::exchange(dropped_, {}); }
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
        uint64_t number = 0;
    };

    explicit Window(Device& device) : device_(device) {}
    [[nodiscard]] Status open(const std::string& title, VkExtent2D size);
    [[nodiscard]] Status createSlots();
    /// Stays stale while the window has no size.
    [[nodiscard]] Status resize();

    Device& device_;
    GLFWwindow* window_ = nullptr;
    bool glfwReady_ = false;
    std::unique_ptr<Swapchain> swapchain_;
    std::vector<KeyPress> keys_;
    std::vector<std::string> dropped_;
    bool stale_ = true; ///< the swapchain no longer fits the window
    std::array<Slot, kFramesInFlight> slots_;
    uint32_t slot_ = 0;
    uint64_t completedFrame_ = 0;
};

} // namespace supple::host
