// The image that the characters are drawn into, with depth and several samples, and that Qt then shows as a texture.
#pragma once

#include "pipelines.h"

namespace qt_quick {

class Picture {
public:
    Picture(const Gpu& gpu, VkExtent2D extent);
    void destroy();

    void begin(VkCommandBuffer commands) const;
    /// Leaves the image as Qt has been told to find it: shader read only, and visible to fragment shaders.
    void end(VkCommandBuffer commands) const;

    VkImage image() const { return shown_.image; }
    VkExtent2D extent() const { return extent_; }

private:
    Gpu gpu_;
    VkExtent2D extent_;
    Image samples_;
    Image depth_;
    Image shown_;
};

/// The depths that the sun sees.
class SunMap {
public:
    explicit SunMap(const Gpu& gpu);
    void destroy();

    void begin(VkCommandBuffer commands) const;
    void end(VkCommandBuffer commands) const;

    VkImageView view() const { return depth_.view; }
    VkSampler sampler() const { return sampler_; }

private:
    Gpu gpu_;
    Image depth_;
    VkSampler sampler_ = VK_NULL_HANDLE;
};

} // namespace qt_quick
