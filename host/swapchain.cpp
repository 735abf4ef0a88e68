#include "host/swapchain.h"

#include "host/vk_struct.h"

#include <algorithm>

namespace supple::host {

namespace {

Status createSemaphore(const Device& device, VkSemaphore& semaphore) {
    const auto info = vkStruct<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
    if (const VkResult result = vkCreateSemaphore(device.handle(), &info, nullptr, &semaphore); result != VK_SUCCESS)
        return vulkanError(result, "vkCreateSemaphore");
    return success();
}

} // namespace

Result<std::unique_ptr<Swapchain>> Swapchain::create(Device& device, VkSurfaceKHR surface) {
    std::unique_ptr<Swapchain> swapchain(new Swapchain(device, surface));
    if (const Status status = swapchain->chooseFormat(); !status)
        return status.error();
    for (VkSemaphore& semaphore : swapchain->acquired_) {
        if (const Status status = createSemaphore(device, semaphore); !status)
            return status.error();
    }
    return swapchain;
}

Swapchain::~Swapchain() {
    device_.waitIdle();
    destroyViews();
    for (const VkSemaphore semaphore : acquired_)
        vkDestroySemaphore(device_.handle(), semaphore, nullptr);
    if (swapchain_ != VK_NULL_HANDLE)
        vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
    vkDestroySurfaceKHR(device_.instance(), surface_, nullptr);
}

Status Swapchain::chooseFormat() {
    VkBool32 presents = VK_FALSE;
    vkGetPhysicalDeviceSurfaceSupportKHR(device_.physicalDevice(), device_.queueFamily(), surface_, &presents);
    if (presents == VK_FALSE)
        return Error{ErrorCode::unsupported, device_.name() + " cannot show pictures in this window"};
    uint32_t count = 0;
    vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physicalDevice(), surface_, &count, nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physicalDevice(), surface_, &count, formats.data());
    for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM}) {
        for (const VkSurfaceFormatKHR& format : formats) {
            if (format.format == wanted && format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) {
                format_ = format;
                return success();
            }
        }
    }
    return Error{ErrorCode::unsupported, "the window takes no 8-bit RGB pictures"};
}

void Swapchain::destroyViews() {
    for (const VkImageView view : views_)
        vkDestroyImageView(device_.handle(), view, nullptr);
    for (const VkSemaphore semaphore : drawn_)
        vkDestroySemaphore(device_.handle(), semaphore, nullptr);
    views_.clear();
    drawn_.clear();
    images_.clear();
}

Result<bool> Swapchain::resize(VkExtent2D drawable) {
    VkSurfaceCapabilitiesKHR surface{};
    if (const VkResult result = vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physicalDevice(), surface_, &surface);
        result != VK_SUCCESS)
        return vulkanError(result, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    VkExtent2D extent = surface.currentExtent;
    if (extent.width == UINT32_MAX) // the swapchain decides the size, not the surface
        extent = {std::clamp(drawable.width, surface.minImageExtent.width, surface.maxImageExtent.width),
                  std::clamp(drawable.height, surface.minImageExtent.height, surface.maxImageExtent.height)};
    if (extent.width == 0 || extent.height == 0)
        return false;
    device_.waitIdle();
    if (const Status status = createSwapchain(surface, extent); !status)
        return status.error();
    if (const Status status = createViews(); !status)
        return status.error();
    ++generation_;
    return true;
}

Status Swapchain::createSwapchain(const VkSurfaceCapabilitiesKHR& surface, VkExtent2D extent) {
    constexpr VkImageUsageFlags kNeeded = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if ((surface.supportedUsageFlags & kNeeded) != kNeeded)
        return Error{ErrorCode::unsupported, "pictures cannot be copied to the window"};
    canRead_ = (surface.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_SRC_BIT) != 0;

    auto info = vkStruct<VkSwapchainCreateInfoKHR>(VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR);
    info.surface = surface_;
    info.minImageCount = surface.minImageCount + 1;
    if (surface.maxImageCount != 0)
        info.minImageCount = std::min(info.minImageCount, surface.maxImageCount);
    info.imageFormat = format_.format;
    info.imageColorSpace = format_.colorSpace;
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
    destroyViews();
    if (swapchain_ != VK_NULL_HANDLE)
        vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
    swapchain_ = swapchain;
    extent_ = extent;
    return success();
}

Status Swapchain::createViews() {
    uint32_t count = 0;
    vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, nullptr);
    images_.resize(count);
    vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, images_.data());
    for (const VkImage image : images_) {
        auto viewInfo = vkStruct<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
        viewInfo.image = image;
        viewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
        viewInfo.format = format_.format;
        viewInfo.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        VkImageView view = VK_NULL_HANDLE;
        if (const VkResult result = vkCreateImageView(device_.handle(), &viewInfo, nullptr, &view);
            result != VK_SUCCESS)
            return vulkanError(result, "vkCreateImageView");
        views_.push_back(view);
        if (const Status status = createSemaphore(device_, drawn_.emplace_back()); !status)
            return status.error();
    }
    return success();
}

Result<bool> Swapchain::acquire(uint32_t slot) {
    const VkResult result =
        vkAcquireNextImageKHR(device_.handle(), swapchain_, UINT64_MAX, acquired_[slot], VK_NULL_HANDLE, &index_);
    if (result == VK_ERROR_OUT_OF_DATE_KHR)
        return false;
    // A suboptimal image can still be drawn and shown; present() reports it.
    if (result != VK_SUCCESS && result != VK_SUBOPTIMAL_KHR)
        return vulkanError(result, "vkAcquireNextImageKHR");
    return true;
}

Result<bool> Swapchain::present() {
    auto info = vkStruct<VkPresentInfoKHR>(VK_STRUCTURE_TYPE_PRESENT_INFO_KHR);
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &drawn_[index_];
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain_;
    info.pImageIndices = &index_;
    const VkResult result = vkQueuePresentKHR(device_.queue(), &info);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR)
        return false;
    if (result != VK_SUCCESS)
        return vulkanError(result, "vkQueuePresentKHR");
    return true;
}

} // namespace supple::host
