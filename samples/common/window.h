// An SDL window and its swapchain.
#pragma once

#include "graph.h"

#include <SDL.h>

#include <optional>

namespace engine {

/// SDL itself and a window of it: made before the device, which must know the window's surface.
class SdlWindow {
public:
    SdlWindow(const char* title, VkExtent2D size);
    ~SdlWindow();
    SdlWindow(const SdlWindow&) = delete;
    SdlWindow& operator=(const SdlWindow&) = delete;

    std::vector<const char*> instanceExtensions() const;
    VkSurfaceKHR createSurface(VkInstance instance) const;
    VkExtent2D drawableSize() const;
    void setTitle(const std::string& title) { SDL_SetWindowTitle(window_, title.c_str()); }
    /// False once the user wants to leave.
    bool pollEvents();
    /// Whether the size has changed since it was last asked; not every driver tells with the swapchain.
    bool takeResized() { return std::exchange(resized_, false); }

private:
    SDL_Window* window_ = nullptr;
    bool resized_ = false;
};

class Swapchain {
public:
    Swapchain(const sample::Device& device, const SdlWindow& window, Graph& graph);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    /// Anew, in the window's size; nothing may be in flight. False while the window has none.
    bool create();
    VkExtent2D extent() const { return extent_; }
    /// Waits for an image. False: the swapchain must be created anew.
    bool acquire(uint32_t slot);
    /// Passes that copy `picture` to the acquired image and make it ready to be shown.
    void addToGraph(Graph& graph, const sample::Image& picture, Resource pictureUse);
    VkSemaphore acquired(uint32_t slot) const { return acquired_[slot]; }
    VkSemaphore drawn() const { return drawn_[index_]; }
    /// Where `acquired` must have been waited for.
    static constexpr VkPipelineStageFlags2 kFirstUse = VK_PIPELINE_STAGE_2_BLIT_BIT;
    /// False: the swapchain must be created anew.
    bool present();

private:
    void destroySemaphores();

    const sample::Device& device_;
    const SdlWindow& window_;
    Resource use_;
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
    std::vector<VkImage> images_;
    std::vector<VkSemaphore> drawn_; ///< an image
    VkSemaphore acquired_[sample::kFramesInFlight]{};
    uint32_t index_ = 0;
};

} // namespace engine
