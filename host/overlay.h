// Dear ImGui over the window's picture.
#pragma once

#include "host/window.h"

#include <memory>
#include <vector>

namespace supple::host {

class Overlay {
public:
    [[nodiscard]] static Result<std::unique_ptr<Overlay>> create(Device& device, Window& window);
    ~Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    /// Between these two the caller builds its panels with ImGui.
    void beginPanels();
    void endPanels();
    /// Draws the panels over the frame's image, which is in COLOR_ATTACHMENT_OPTIMAL and left in PRESENT_SRC_KHR.
    [[nodiscard]] Status record(const WindowFrame& frame);

private:
    Overlay(Device& device, Window& window) : device_(device), window_(window) {}
    [[nodiscard]] Status createRenderPass();
    [[nodiscard]] Status createFramebuffers();
    [[nodiscard]] Status startImGui();
    void destroyFramebuffers();

    Device& device_;
    Window& window_;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkRenderPass renderPass_ = VK_NULL_HANDLE;
    std::vector<VkFramebuffer> framebuffers_;
    uint32_t generation_ = 0; ///< of the swapchain the framebuffers belong to
    bool platformReady_ = false;
    bool rendererReady_ = false;
};

} // namespace supple::host
