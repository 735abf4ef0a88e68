// Dear ImGui over the window's picture.
#pragma once

#include "host/fallback_fonts.h"
#include "host/window.h"

#include <imgui.h>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace supple::host {

class Overlay {
public:
    [[nodiscard]] static Result<std::unique_ptr<Overlay>> create(Device& device, Window& window);
    ~Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    /// Panels may show this UTF-8 text from now on: loads fonts of the system for characters that were not shown
    /// before. Text that was shown before costs a look at each character. Not between beginPanels() and record().
    [[nodiscard]] Status showText(std::string_view text);
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
    [[nodiscard]] Status startRenderer();
    void buildFonts();
    void destroyFramebuffers();

    Device& device_;
    Window& window_;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkRenderPass renderPass_ = VK_NULL_HANDLE;
    std::vector<VkFramebuffer> framebuffers_;
    float scale_ = 1.0f;        ///< of the display
    std::u32string characters_; ///< beyond ASCII that were asked for, rising
    std::vector<FallbackFont> fonts_;
    std::vector<std::vector<ImWchar>> fontRanges_; ///< of each of them
    uint32_t generation_ = 0;                      ///< of the swapchain the framebuffers belong to
    bool platformReady_ = false;
    bool rendererReady_ = false;
};

} // namespace supple::host
