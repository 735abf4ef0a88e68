// Buffers and images with memory of their own, and what is to be destroyed once the device has done with it.
#pragma once

#include "vk.h"

#include <deque>
#include <functional>

namespace qt_quick {

struct Gpu {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
};

struct Image {
    VkImage image = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
};

struct ImageShape {
    VkFormat format{};
    VkExtent2D extent{};
    VkImageUsageFlags usage{};
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    uint32_t levels = 1;
};

struct Buffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
};

Image createImage(const Gpu& gpu, const ImageShape& shape);
void destroyImage(const Gpu& gpu, const Image& image);
/// hostVisible: else in the device's own memory.
Buffer createBuffer(const Gpu& gpu, VkDeviceSize size, VkBufferUsageFlags usage, bool hostVisible);
void destroyBuffer(const Gpu& gpu, const Buffer& buffer);

/// The barrier of one image, all levels, or from a level on.
void transition(VkCommandBuffer commands, VkImage image, SuppleSyncScope before, VkImageLayout from,
                SuppleSyncScope after, VkImageLayout to,
                VkImageSubresourceRange range = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0, 1});

/// Frames in flight may still use what the host has done with.
class Retired {
public:
    void add(uint64_t lastFrame, std::function<void()> destroy) { entries_.push_back({lastFrame, std::move(destroy)}); }
    void collect(uint64_t completedFrame);

private:
    struct Entry {
        uint64_t lastFrame;
        std::function<void()> destroy;
    };
    std::deque<Entry> entries_;
};

} // namespace qt_quick
