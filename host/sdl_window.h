// An SDL window. What fails here ends the process with exit code 3 (host/must.h).
#pragma once

#include "host/swapchain.h"

#include <SDL.h>

#include <string>
#include <utility>

namespace supple::host {

/// SDL itself and a window of it.
class SdlWindow {
public:
    SdlWindow(const char* title, VkExtent2D size);
    ~SdlWindow();
    SdlWindow(const SdlWindow&) = delete;
    SdlWindow& operator=(const SdlWindow&) = delete;

    /// The device must have been created with DeviceOptions::window. The swapchain has no images yet.
    [[nodiscard]] std::unique_ptr<Swapchain> createSwapchain(Device& device) const;
    [[nodiscard]] VkExtent2D drawableSize() const;
    void setTitle(const std::string& title) { SDL_SetWindowTitle(window_, title.c_str()); }
    /// False once the user wants to leave.
    bool pollEvents();
    /// Whether the size has changed since it was last asked; not every driver tells with the swapchain.
    bool takeResized() { return std::exchange(resized_, false); }

private:
    SDL_Window* window_ = nullptr;
    bool resized_ = false;
};

} // namespace supple::host
