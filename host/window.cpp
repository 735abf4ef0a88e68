#include "host/window.h"

#include "host/vk_struct.h"

#include <algorithm>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace supple::host {

namespace {

std::string glfwReason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "unknown";
}

} // namespace

Result<std::unique_ptr<Window>> Window::create(Device& device, const std::string& title, VkExtent2D size) {
    std::unique_ptr<Window> window(new Window(device));
    if (const Status status = window->open(title, size); !status)
        return status.error();
    if (const Status status = window->chooseFormat(); !status)
        return status.error();
    if (const Status status = window->createSlots(); !status)
        return status.error();
    if (const Status status = window->createSwapchain(); !status)
        return status.error();
    return window;
}

Window::~Window() {
    const VkDevice device = device_.handle();
    vkDeviceWaitIdle(device);
    destroySwapchainViews();
    if (swapchain_ != VK_NULL_HANDLE)
        vkDestroySwapchainKHR(device, swapchain_, nullptr);
    for (const Slot& slot : slots_) {
        vkDestroyFence(device, slot.done, nullptr);
        vkDestroySemaphore(device, slot.acquired, nullptr);
        if (slot.commands != VK_NULL_HANDLE)
            vkFreeCommandBuffers(device, device_.commandPool(), 1, &slot.commands);
    }
    if (surface_ != VK_NULL_HANDLE)
        vkDestroySurfaceKHR(device_.instance(), surface_, nullptr);
    if (window_ != nullptr)
        glfwDestroyWindow(window_);
    if (glfwReady_)
        glfwTerminate();
}

Status Window::open(const std::string& title, VkExtent2D size) {
    if (glfwInit() == GLFW_FALSE)
        return Error{ErrorCode::unsupported, "no window: " + glfwReason()};
    glfwReady_ = true;
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ =
        glfwCreateWindow(static_cast<int>(size.width), static_cast<int>(size.height), title.c_str(), nullptr, nullptr);
    if (window_ == nullptr)
        return Error{ErrorCode::unsupported, "no window: " + glfwReason()};
    if (const VkResult result = glfwCreateWindowSurface(device_.instance(), window_, nullptr, &surface_);
        result != VK_SUCCESS) {
        Error error = vulkanError(result, "no surface for the window");
        error.code = ErrorCode::unsupported;
        return error;
    }
    VkBool32 presents = VK_FALSE;
    vkGetPhysicalDeviceSurfaceSupportKHR(device_.physicalDevice(), device_.queueFamily(), surface_, &presents);
    if (presents == VK_FALSE)
        return Error{ErrorCode::unsupported, device_.name() + " cannot show pictures in this window"};
    glfwSetWindowUserPointer(window_, this);
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int, int) {
        static_cast<Window*>(glfwGetWindowUserPointer(window))->stale_ = true;
    });
    return success();
}

bool Window::shouldClose() const {
    return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

Status Window::chooseFormat() {
    uint32_t count = 0;
    vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physicalDevice(), surface_, &count, nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physicalDevice(), surface_, &count, formats.data());
    for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM}) {
        for (const VkSurfaceFormatKHR& format : formats) {
            if (format.format == wanted && format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) {
                format_ = format.format;
                colorSpace_ = format.colorSpace;
                return success();
            }
        }
    }
    return Error{ErrorCode::unsupported, "the window takes no 8-bit RGB pictures"};
}

Status Window::createSlots() {
    const VkDevice device = device_.handle();
    for (Slot& slot : slots_) {
        auto commandInfo = vkStruct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
        commandInfo.commandPool = device_.commandPool();
        commandInfo.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        commandInfo.commandBufferCount = 1;
        auto fenceInfo = vkStruct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
        fenceInfo.flags = VK_FENCE_CREATE_SIGNALED_BIT;
        const auto semaphoreInfo = vkStruct<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
        for (const VkResult result : {vkAllocateCommandBuffers(device, &commandInfo, &slot.commands),
                                      vkCreateFence(device, &fenceInfo, nullptr, &slot.done),
                                      vkCreateSemaphore(device, &semaphoreInfo, nullptr, &slot.acquired)}) {
            if (result != VK_SUCCESS)
                return vulkanError(result, "the window's frames");
        }
    }
    return success();
}

void Window::destroySwapchainViews() {
    for (const VkImageView view : views_)
        vkDestroyImageView(device_.handle(), view, nullptr);
    for (const VkSemaphore semaphore : drawn_)
        vkDestroySemaphore(device_.handle(), semaphore, nullptr);
    views_.clear();
    drawn_.clear();
    images_.clear();
}

VkExtent2D Window::drawableExtent(const VkSurfaceCapabilitiesKHR& surface) const {
    if (surface.currentExtent.width != UINT32_MAX)
        return surface.currentExtent;
    int width = 0; // the swapchain decides the size, not the surface
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {std::clamp(static_cast<uint32_t>(width), surface.minImageExtent.width, surface.maxImageExtent.width),
            std::clamp(static_cast<uint32_t>(height), surface.minImageExtent.height, surface.maxImageExtent.height)};
}

Status Window::createSwapchain() {
    VkSurfaceCapabilitiesKHR surface{};
    if (const VkResult result = vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physicalDevice(), surface_, &surface);
        result != VK_SUCCESS)
        return vulkanError(result, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    const VkExtent2D extent = drawableExtent(surface);
    if (extent.width == 0 || extent.height == 0)
        return success(); // minimised: stale until it has a size again

    constexpr VkImageUsageFlags kNeeded = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if ((surface.supportedUsageFlags & kNeeded) != kNeeded)
        return Error{ErrorCode::unsupported, "pictures cannot be copied to the window"};
    canRead_ = (surface.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_SRC_BIT) != 0;

    vkDeviceWaitIdle(device_.handle());
    auto info = vkStruct<VkSwapchainCreateInfoKHR>(VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR);
    info.surface = surface_;
    info.minImageCount = surface.minImageCount + 1;
    if (surface.maxImageCount != 0)
        info.minImageCount = std::min(info.minImageCount, surface.maxImageCount);
    info.imageFormat = format_;
    info.imageColorSpace = colorSpace_;
    info.imageExtent = extent;
    info.imageArrayLayers = 1;
    info.imageUsage = kNeeded;
    if (canRead_)
        info.imageUsage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    info.preTransform = surface.currentTransform;
    info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    if ((surface.supportedCompositeAlpha & info.compositeAlpha) == 0)
        info.compositeAlpha = VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
    info.clipped = VK_TRUE;
    info.oldSwapchain = swapchain_;
    VkSwapchainKHR swapchain = VK_NULL_HANDLE;
    if (const VkResult result = vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &swapchain);
        result != VK_SUCCESS)
        return vulkanError(result, "vkCreateSwapchainKHR");
    destroySwapchainViews();
    if (swapchain_ != VK_NULL_HANDLE)
        vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
    swapchain_ = swapchain;
    extent_ = extent;
    if (const Status status = createSwapchainViews(); !status)
        return status.error();
    ++generation_;
    stale_ = false;
    return success();
}

Status Window::createSwapchainViews() {
    uint32_t count = 0;
    vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, nullptr);
    images_.resize(count);
    vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, images_.data());
    for (const VkImage image : images_) {
        auto viewInfo = vkStruct<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
        viewInfo.image = image;
        viewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
        viewInfo.format = format_;
        viewInfo.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        VkImageView view = VK_NULL_HANDLE;
        if (const VkResult result = vkCreateImageView(device_.handle(), &viewInfo, nullptr, &view);
            result != VK_SUCCESS)
            return vulkanError(result, "vkCreateImageView");
        views_.push_back(view);
        const auto semaphoreInfo = vkStruct<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
        VkSemaphore semaphore = VK_NULL_HANDLE;
        if (const VkResult result = vkCreateSemaphore(device_.handle(), &semaphoreInfo, nullptr, &semaphore);
            result != VK_SUCCESS)
            return vulkanError(result, "vkCreateSemaphore");
        drawn_.push_back(semaphore);
    }
    return success();
}

Result<std::optional<WindowFrame>> Window::begin() {
    glfwPollEvents();
    if (stale_) {
        if (const Status status = createSwapchain(); !status)
            return status.error();
        if (stale_) {
            glfwWaitEventsTimeout(0.1);
            return std::optional<WindowFrame>();
        }
    }
    Slot& slot = slots_[slot_];
    if (const VkResult result = vkWaitForFences(device_.handle(), 1, &slot.done, VK_TRUE, UINT64_MAX);
        result != VK_SUCCESS)
        return vulkanError(result, "vkWaitForFences");
    completedFrame_ = std::max(completedFrame_, slot.number);
    WindowFrame frame{slot.commands, slot_, 0};
    const VkResult acquired =
        vkAcquireNextImageKHR(device_.handle(), swapchain_, UINT64_MAX, slot.acquired, VK_NULL_HANDLE, &frame.image);
    if (acquired == VK_ERROR_OUT_OF_DATE_KHR) {
        stale_ = true;
        return std::optional<WindowFrame>();
    }
    if (acquired != VK_SUCCESS && acquired != VK_SUBOPTIMAL_KHR)
        return vulkanError(acquired, "vkAcquireNextImageKHR");
    // A suboptimal image can still be drawn and shown; the swapchain is rebuilt after it.
    stale_ = stale_ || acquired == VK_SUBOPTIMAL_KHR;
    vkResetFences(device_.handle(), 1, &slot.done);
    auto beginInfo = vkStruct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    beginInfo.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    if (const VkResult result = vkBeginCommandBuffer(slot.commands, &beginInfo); result != VK_SUCCESS)
        return vulkanError(result, "vkBeginCommandBuffer");
    return std::optional<WindowFrame>(frame);
}

Status Window::end(const WindowFrame& frame, uint64_t number) {
    Slot& slot = slots_[frame.slot];
    if (const VkResult result = vkEndCommandBuffer(slot.commands); result != VK_SUCCESS)
        return vulkanError(result, "vkEndCommandBuffer");
    auto wait = vkStruct<VkSemaphoreSubmitInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO);
    wait.semaphore = slot.acquired;
    wait.stageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    auto signal = vkStruct<VkSemaphoreSubmitInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO);
    signal.semaphore = drawn_[frame.image];
    signal.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    auto commands = vkStruct<VkCommandBufferSubmitInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO);
    commands.commandBuffer = slot.commands;
    auto submit = vkStruct<VkSubmitInfo2>(VK_STRUCTURE_TYPE_SUBMIT_INFO_2);
    submit.waitSemaphoreInfoCount = 1;
    submit.pWaitSemaphoreInfos = &wait;
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &commands;
    submit.signalSemaphoreInfoCount = 1;
    submit.pSignalSemaphoreInfos = &signal;
    if (const VkResult result = vkQueueSubmit2(device_.queue(), 1, &submit, slot.done); result != VK_SUCCESS)
        return vulkanError(result, "vkQueueSubmit2");
    slot.number = number;
    slot_ = (slot_ + 1) % kWindowFramesInFlight;

    auto present = vkStruct<VkPresentInfoKHR>(VK_STRUCTURE_TYPE_PRESENT_INFO_KHR);
    present.waitSemaphoreCount = 1;
    present.pWaitSemaphores = &drawn_[frame.image];
    present.swapchainCount = 1;
    present.pSwapchains = &swapchain_;
    present.pImageIndices = &frame.image;
    const VkResult presented = vkQueuePresentKHR(device_.queue(), &present);
    if (presented == VK_ERROR_OUT_OF_DATE_KHR || presented == VK_SUBOPTIMAL_KHR)
        stale_ = true;
    else if (presented != VK_SUCCESS)
        return vulkanError(presented, "vkQueuePresentKHR");
    return success();
}

void Window::waitIdle(uint64_t number) {
    vkDeviceWaitIdle(device_.handle());
    completedFrame_ = std::max(completedFrame_, number);
}

} // namespace supple::host
