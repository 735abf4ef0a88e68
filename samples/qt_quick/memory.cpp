#include "memory.h"

namespace qt_quick {

namespace {

VkDeviceMemory allocate(const Gpu& gpu, const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties) {
    VkPhysicalDeviceMemoryProperties types;
    vkGetPhysicalDeviceMemoryProperties(gpu.physical, &types);
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.allocationSize = needs.size;
    for (uint32_t i = 0; i < types.memoryTypeCount; ++i) {
        if ((needs.memoryTypeBits >> i & 1) == 0 || (types.memoryTypes[i].propertyFlags & properties) != properties)
            continue;
        info.memoryTypeIndex = i;
        VkDeviceMemory memory = VK_NULL_HANDLE;
        must(vkAllocateMemory(gpu.device, &info, nullptr, &memory), "vkAllocateMemory");
        return memory;
    }
    fail("no memory type suits");
}

} // namespace

Image createImage(const Gpu& gpu, const ImageShape& shape) {
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = shape.format;
    info.extent = {shape.extent.width, shape.extent.height, 1};
    info.mipLevels = shape.levels;
    info.arrayLayers = 1;
    info.samples = shape.samples;
    info.usage = shape.usage;
    Image made;
    must(vkCreateImage(gpu.device, &info, nullptr, &made.image), "vkCreateImage");
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(gpu.device, made.image, &needs);
    made.memory = allocate(gpu, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    must(vkBindImageMemory(gpu.device, made.image, made.memory, 0), "vkBindImageMemory");
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = made.image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = shape.format;
    const bool depth = (shape.usage & VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0;
    view.subresourceRange.aspectMask = depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    view.subresourceRange.levelCount = shape.levels;
    view.subresourceRange.layerCount = 1;
    must(vkCreateImageView(gpu.device, &view, nullptr, &made.view), "vkCreateImageView");
    return made;
}

void destroyImage(const Gpu& gpu, const Image& image) {
    vkDestroyImageView(gpu.device, image.view, nullptr);
    vkDestroyImage(gpu.device, image.image, nullptr);
    vkFreeMemory(gpu.device, image.memory, nullptr);
}

Buffer createBuffer(const Gpu& gpu, VkDeviceSize size, VkBufferUsageFlags usage, bool hostVisible) {
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = size;
    info.usage = usage;
    Buffer made;
    must(vkCreateBuffer(gpu.device, &info, nullptr, &made.buffer), "vkCreateBuffer");
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(gpu.device, made.buffer, &needs);
    const VkMemoryPropertyFlags shown = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    made.memory =
        allocate(gpu, needs, hostVisible ? shown : VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT});
    must(vkBindBufferMemory(gpu.device, made.buffer, made.memory, 0), "vkBindBufferMemory");
    return made;
}

void destroyBuffer(const Gpu& gpu, const Buffer& buffer) {
    vkDestroyBuffer(gpu.device, buffer.buffer, nullptr);
    vkFreeMemory(gpu.device, buffer.memory, nullptr);
}

void transition(VkCommandBuffer commands, VkImage image, SuppleSyncScope before, VkImageLayout from,
                SuppleSyncScope after, VkImageLayout to, VkImageSubresourceRange range) {
    VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcStageMask = before.stages;
    barrier.srcAccessMask = before.access;
    barrier.dstStageMask = after.stages;
    barrier.dstAccessMask = after.access;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = range;
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &dependency);
}

void Retired::collect(uint64_t completedFrame) {
    while (!entries_.empty() && entries_.front().lastFrame <= completedFrame) {
        entries_.front().destroy();
        entries_.pop_front();
    }
}

} // namespace qt_quick
