#include "host/overlay.h"

#include "host/vk_struct.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>
#include <iterator>

namespace supple::host {

namespace {

/// Quiet, dark and rounded: the figure is what counts.
void applyStyle(float scale) {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 8.0f;
    style.FrameRounding = 4.0f;
    style.GrabRounding = 4.0f;
    style.PopupRounding = 6.0f;
    style.WindowBorderSize = 0.0f;
    style.WindowPadding = ImVec2(14.0f, 12.0f);
    style.FramePadding = ImVec2(8.0f, 4.0f);
    style.ItemSpacing = ImVec2(8.0f, 7.0f);
    const auto set = [&](ImGuiCol color, float r, float g, float b, float a) {
        style.Colors[color] = ImVec4(r, g, b, a);
    };
    set(ImGuiCol_WindowBg, 0.07f, 0.08f, 0.10f, 0.86f);
    set(ImGuiCol_TitleBg, 0.10f, 0.11f, 0.13f, 1.0f);
    set(ImGuiCol_TitleBgActive, 0.12f, 0.14f, 0.17f, 1.0f);
    set(ImGuiCol_TitleBgCollapsed, 0.07f, 0.08f, 0.10f, 0.86f);
    set(ImGuiCol_FrameBg, 0.16f, 0.18f, 0.21f, 1.0f);
    set(ImGuiCol_FrameBgHovered, 0.21f, 0.23f, 0.27f, 1.0f);
    set(ImGuiCol_FrameBgActive, 0.24f, 0.27f, 0.31f, 1.0f);
    set(ImGuiCol_Button, 0.19f, 0.22f, 0.26f, 1.0f);
    set(ImGuiCol_ButtonHovered, 0.25f, 0.29f, 0.34f, 1.0f);
    set(ImGuiCol_ButtonActive, 0.90f, 0.48f, 0.16f, 1.0f);
    set(ImGuiCol_SliderGrab, 0.90f, 0.48f, 0.16f, 1.0f);
    set(ImGuiCol_SliderGrabActive, 1.0f, 0.58f, 0.24f, 1.0f);
    set(ImGuiCol_CheckMark, 0.96f, 0.55f, 0.20f, 1.0f);
    set(ImGuiCol_Header, 0.22f, 0.25f, 0.30f, 1.0f);
    set(ImGuiCol_HeaderHovered, 0.27f, 0.31f, 0.37f, 1.0f);
    set(ImGuiCol_HeaderActive, 0.90f, 0.48f, 0.16f, 1.0f);
    set(ImGuiCol_PlotHistogram, 0.90f, 0.48f, 0.16f, 1.0f);
    set(ImGuiCol_Separator, 0.24f, 0.26f, 0.30f, 1.0f);
    style.ScaleAllSizes(scale);
}

} // namespace

Result<std::unique_ptr<Overlay>> Overlay::create(Device& device, Window& window) {
    std::unique_ptr<Overlay> overlay(new Overlay(device, window));
    if (const Status status = overlay->createRenderPass(); !status)
        return status.error();
    if (const Status status = overlay->startImGui(); !status)
        return status.error();
    return overlay;
}

Overlay::~Overlay() {
    vkDeviceWaitIdle(device_.handle());
    if (rendererReady_)
        ImGui_ImplVulkan_Shutdown();
    if (platformReady_)
        ImGui_ImplGlfw_Shutdown();
    if (ImGui::GetCurrentContext() != nullptr)
        ImGui::DestroyContext();
    destroyFramebuffers();
    vkDestroyRenderPass(device_.handle(), renderPass_, nullptr);
    vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
}

Status Overlay::createRenderPass() {
    VkAttachmentDescription attachment{};
    attachment.format = window_.swapchain().format();
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachment.initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachment.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    // A copy for a screenshot may follow.
    VkSubpassDependency dependency{};
    dependency.srcSubpass = 0;
    dependency.dstSubpass = VK_SUBPASS_EXTERNAL;
    dependency.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    dependency.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    dependency.dstStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT;
    dependency.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
    auto info = vkStruct<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
    info.attachmentCount = 1;
    info.pAttachments = &attachment;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 1;
    info.pDependencies = &dependency;
    if (const VkResult result = vkCreateRenderPass(device_.handle(), &info, nullptr, &renderPass_);
        result != VK_SUCCESS)
        return vulkanError(result, "vkCreateRenderPass");
    return success();
}

Status Overlay::startImGui() {
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4};
    auto poolInfo = vkStruct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    poolInfo.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    poolInfo.maxSets = 4;
    poolInfo.poolSizeCount = 1;
    poolInfo.pPoolSizes = &size;
    if (const VkResult result = vkCreateDescriptorPool(device_.handle(), &poolInfo, nullptr, &pool_);
        result != VK_SUCCESS)
        return vulkanError(result, "vkCreateDescriptorPool");

    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // leaves no file behind
    glfwGetWindowContentScale(window_.handle(), &scale_, nullptr);
    applyStyle(scale_);
    buildFonts();
    if (!ImGui_ImplGlfw_InitForVulkan(window_.handle(), true))
        return Error{ErrorCode::unsupported, "ImGui does not take the window"};
    platformReady_ = true;
    return startRenderer();
}

Status Overlay::startRenderer() {
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = device_.instance();
    info.PhysicalDevice = device_.physicalDevice();
    info.Device = device_.handle();
    info.QueueFamily = device_.queueFamily();
    info.Queue = device_.queue();
    info.DescriptorPool = pool_;
    // ImGui keeps vertex buffers for so many frames; it cares for nothing else of the swapchain.
    info.MinImageCount = 2;
    info.ImageCount = kFramesInFlight + 1;
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    if (!ImGui_ImplVulkan_Init(&info, renderPass_))
        return Error{ErrorCode::vulkan, "ImGui does not take the device"};
    rendererReady_ = true;
    const Status status =
        device_.submitAndWait([](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
    ImGui_ImplVulkan_DestroyFontUploadObjects();
    return status;
}

void Overlay::buildFonts() {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    ImFontConfig config;
    config.SizePixels = 13.0f * scale_;
    atlas.AddFontDefault(&config);
    fontRanges_.clear();
    for (FallbackFont& font : fonts_) {
        std::vector<ImWchar>& ranges = fontRanges_.emplace_back();
        for (const char32_t character : font.characters)
            ranges.insert(ranges.end(), 2, static_cast<ImWchar>(character));
        ranges.push_back(0);
        ImFontConfig merged;
        merged.MergeMode = true;
        merged.GlyphOffset.y = scale_; // on the line of the built-in font
        merged.FontNo = font.file.index;
        merged.FontDataOwnedByAtlas = false;
        atlas.AddFontFromMemoryTTF(font.bytes.data(), static_cast<int>(font.bytes.size()), 14.0f * scale_, &merged,
                                   ranges.data());
    }
    atlas.Build();
}

Status Overlay::showText(std::string_view text) {
    std::u32string asked = charactersBeyondAscii(text);
    std::erase_if(asked, [](char32_t character) { return character > IM_UNICODE_CODEPOINT_MAX; });
    if (std::includes(characters_.begin(), characters_.end(), asked.begin(), asked.end()))
        return success();
    std::u32string all;
    std::set_union(characters_.begin(), characters_.end(), asked.begin(), asked.end(), std::back_inserter(all));
    characters_ = std::move(all);
    std::vector<FallbackFont> fonts = fallbackFonts(characters_);
    if (fonts.empty())
        return success();
    vkDeviceWaitIdle(device_.handle());
    ImGui_ImplVulkan_Shutdown();
    rendererReady_ = false;
    fonts_ = std::move(fonts);
    buildFonts();
    if (const VkResult result = vkResetDescriptorPool(device_.handle(), pool_, 0); result != VK_SUCCESS)
        return vulkanError(result, "vkResetDescriptorPool");
    return startRenderer();
}

void Overlay::destroyFramebuffers() {
    for (const VkFramebuffer framebuffer : framebuffers_)
        vkDestroyFramebuffer(device_.handle(), framebuffer, nullptr);
    framebuffers_.clear();
}

Status Overlay::createFramebuffers() {
    vkDeviceWaitIdle(device_.handle());
    destroyFramebuffers();
    for (const VkImageView view : window_.swapchain().views()) {
        auto info = vkStruct<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
        info.renderPass = renderPass_;
        info.attachmentCount = 1;
        info.pAttachments = &view;
        info.width = window_.swapchain().extent().width;
        info.height = window_.swapchain().extent().height;
        info.layers = 1;
        VkFramebuffer framebuffer = VK_NULL_HANDLE;
        if (const VkResult result = vkCreateFramebuffer(device_.handle(), &info, nullptr, &framebuffer);
            result != VK_SUCCESS)
            return vulkanError(result, "vkCreateFramebuffer");
        framebuffers_.push_back(framebuffer);
    }
    generation_ = window_.swapchain().generation();
    return success();
}

void Overlay::beginPanels() {
    ImGui_ImplVulkan_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Overlay::endPanels() {
    ImGui::Render();
}

Status Overlay::record(const WindowFrame& frame) {
    if (generation_ != window_.swapchain().generation()) {
        if (const Status status = createFramebuffers(); !status)
            return status.error();
    }
    auto info = vkStruct<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    info.renderPass = renderPass_;
    info.framebuffer = framebuffers_[frame.image];
    info.renderArea = {{0, 0}, window_.swapchain().extent()};
    vkCmdBeginRenderPass(frame.commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), frame.commands);
    vkCmdEndRenderPass(frame.commands);
    return success();
}

} // namespace supple::host
