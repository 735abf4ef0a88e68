#include "window.h"

#include <SDL_vulkan.h>

#include <algorithm>

namespace engine {

SdlWindow::SdlWindow(const char* title, VkExtent2D size) {
    SDL_SetMainReady();
    if (SDL_Init(SDL_INIT_VIDEO) != 0)
        sample::fail(std::string("no window: ") + SDL_GetError(), 3);
    window_ = SDL_CreateWindow(title, SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, static_cast<int>(size.width),
                               static_cast<int>(size.height), SDL_WINDOW_VULKAN | SDL_WINDOW_RESIZABLE);
    if (window_ == nullptr)
        sample::fail(std::string("no window: ") + SDL_GetError(), 3);
}

SdlWindow::~SdlWindow() {
    SDL_DestroyWindow(window_);
    SDL_Quit();
}

std::vector<const char*> SdlWindow::instanceExtensions() const {
    unsigned count = 0;
    SDL_Vulkan_GetInstanceExtensions(window_, &count, nullptr);
    std::vector<const char*> names(count);
    SDL_Vulkan_GetInstanceExtensions(window_, &count, names.data());
    return names;
}

VkSurfaceKHR SdlWindow::createSurface(VkInstance instance) const {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (SDL_Vulkan_CreateSurface(window_, instance, &surface) == SDL_FALSE)
        sample::fail(std::string("no surface: ") + SDL_GetError(), 3);
    return surface;
}

VkExtent2D SdlWindow::drawableSize() const {
    int width = 0;
    int height = 0;
    SDL_Vulkan_GetDrawableSize(window_, &width, &height);
    return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

bool SdlWindow::pollEvents() {
    bool stays = true;
    for (SDL_Event event; SDL_PollEvent(&event) != 0;) {
        const bool escape = event.type == SDL_KEYDOWN && event.key.keysym.sym == SDLK_ESCAPE;
        resized_ = resized_ || (event.type == SDL_WINDOWEVENT && event.window.event == SDL_WINDOWEVENT_SIZE_CHANGED);
        stays = stays && event.type != SDL_QUIT && !escape;
    }
    return stays;
}

Swapchain::Swapchain(const sample::Device& device, const SdlWindow& window, Graph& graph)
    : device_(device), window_(window), use_(graph.addImage()) {
    for (VkSemaphore& semaphore : acquired_) {
        const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
        sample::check(vkCreateSemaphore(device.handle(), &info, nullptr, &semaphore), "vkCreateSemaphore");
    }
}

Swapchain::~Swapchain() {
    device_.waitIdle();
    destroySemaphores();
    for (const VkSemaphore semaphore : acquired_)
        vkDestroySemaphore(device_.handle(), semaphore, nullptr);
    vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
}

void Swapchain::destroySemaphores() {
    for (const VkSemaphore semaphore : drawn_)
        vkDestroySemaphore(device_.handle(), semaphore, nullptr);
    drawn_.clear();
}

bool Swapchain::create() {
    VkSurfaceCapabilitiesKHR surface{};
    sample::check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physicalDevice(), device_.surface(), &surface),
                  "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    VkExtent2D extent = surface.currentExtent;
    if (extent.width == UINT32_MAX) { // the swapchain decides
        extent = window_.drawableSize();
        extent.width = std::clamp(extent.width, surface.minImageExtent.width, surface.maxImageExtent.width);
        extent.height = std::clamp(extent.height, surface.minImageExtent.height, surface.maxImageExtent.height);
    }
    if (extent.width == 0 || extent.height == 0)
        return false; // minimized

    uint32_t count = 0;
    vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physicalDevice(), device_.surface(), &count, nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physicalDevice(), device_.surface(), &count, formats.data());
    // The picture is sRGB already, so it is copied into a format that does not convert.
    const auto format = std::find_if(formats.begin(), formats.end(), [](const VkSurfaceFormatKHR& candidate) {
        return (candidate.format == VK_FORMAT_B8G8R8A8_UNORM || candidate.format == VK_FORMAT_R8G8B8A8_UNORM) &&
               candidate.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
    });
    if (format == formats.end() || (surface.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT) == 0)
        sample::fail("8-bit pictures cannot be copied to this window", 3);

    const VkSwapchainKHR old = swapchain_;
    const VkSwapchainCreateInfoKHR info{
        .sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
        .surface = device_.surface(),
        .minImageCount = std::min(surface.minImageCount + 1, surface.maxImageCount != 0 ? surface.maxImageCount : 99u),
        .imageFormat = format->format,
        .imageColorSpace = format->colorSpace,
        .imageExtent = extent,
        .imageArrayLayers = 1,
        .imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT,
        .preTransform = surface.currentTransform,
        .compositeAlpha = (surface.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0
                              ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                              : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR,
        .presentMode = VK_PRESENT_MODE_FIFO_KHR,
        .clipped = VK_TRUE,
        .oldSwapchain = old};
    sample::check(vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &swapchain_), "vkCreateSwapchainKHR");
    vkDestroySwapchainKHR(device_.handle(), old, nullptr);
    extent_ = extent;

    vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, nullptr);
    images_.resize(count);
    vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, images_.data());
    destroySemaphores();
    drawn_.resize(count);
    for (VkSemaphore& semaphore : drawn_) {
        const VkSemaphoreCreateInfo semaphoreInfo{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
        sample::check(vkCreateSemaphore(device_.handle(), &semaphoreInfo, nullptr, &semaphore), "vkCreateSemaphore");
    }
    return true;
}

bool Swapchain::acquire(uint32_t slot) {
    const VkResult result =
        vkAcquireNextImageKHR(device_.handle(), swapchain_, UINT64_MAX, acquired_[slot], VK_NULL_HANDLE, &index_);
    if (result == VK_ERROR_OUT_OF_DATE_KHR)
        return false;
    if (result != VK_SUBOPTIMAL_KHR) // that can still be shown; present() reports it
        sample::check(result, "vkAcquireNextImageKHR");
    return true;
}

void Swapchain::addToGraph(Graph& graph, const sample::Image& picture, Resource pictureUse) {
    graph.setImage(use_, images_[index_], {kFirstUse, 0});
    graph.add(
        "present",
        {reads(pictureUse, {VK_PIPELINE_STAGE_2_BLIT_BIT, VK_ACCESS_2_TRANSFER_READ_BIT},
               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL),
         writes(use_, {VK_PIPELINE_STAGE_2_BLIT_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, true)},
        [this, &picture](VkCommandBuffer commands) {
            const VkExtent2D from = picture.desc().extent;
            const VkImageBlit region{
                .srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                .srcOffsets = {{}, {static_cast<int32_t>(from.width), static_cast<int32_t>(from.height), 1}},
                .dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                .dstOffsets = {{}, {static_cast<int32_t>(extent_.width), static_cast<int32_t>(extent_.height), 1}}};
            vkCmdBlitImage(commands, picture.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, images_[index_],
                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_NEAREST);
        });
    // No commands: only the barrier into the layout of what is shown. The semaphore of the submission does the rest.
    graph.add("show", {reads(use_, {}, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR)}, [](VkCommandBuffer) {});
}

bool Swapchain::present() {
    const VkPresentInfoKHR info{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                .waitSemaphoreCount = 1,
                                .pWaitSemaphores = &drawn_[index_],
                                .swapchainCount = 1,
                                .pSwapchains = &swapchain_,
                                .pImageIndices = &index_};
    const VkResult result = vkQueuePresentKHR(device_.queue(), &info);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR)
        return false;
    sample::check(result, "vkQueuePresentKHR");
    return true;
}

} // namespace engine
