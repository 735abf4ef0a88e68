// The images a picture is drawn into: multisampled color and depth where the device can, one resolved color image.
#pragma once

#include "host/device.h"
#include "host/picture.h"

namespace supple::host {

inline constexpr VkFormat kPictureFormat = VK_FORMAT_R8G8B8A8_SRGB;
inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

/// 4 where that is wanted and the device multisamples color and depth, else 1.
[[nodiscard]] VkSampleCountFlagBits pictureSamples(const Device& device, bool multisample);

class DrawTarget {
public:
    DrawTarget() = default;
    /// The color format must be an sRGB one of 8 bits: shaders write linear light.
    [[nodiscard]] static Result<DrawTarget> create(Device& device, VkExtent2D extent, VkSampleCountFlagBits samples,
                                                   VkFormat format = kPictureFormat);

    [[nodiscard]] VkExtent2D extent() const { return color_.desc().extent; }
    [[nodiscard]] VkSampleCountFlagBits samples() const { return depth_.desc().samples; }
    /// The finished picture; SurfaceRenderer::record leaves it in TRANSFER_SRC_OPTIMAL.
    [[nodiscard]] const Image& color() const { return color_; }
    /// Null (no handle) without multisampling.
    [[nodiscard]] const Image& multisampled() const { return multisampled_; }
    [[nodiscard]] const Image& depth() const { return depth_; }

private:
    Image color_;
    Image multisampled_;
    Image depth_;
};

/// Copies an image of 8-bit RGBA or BGRA in TRANSFER_SRC_OPTIMAL to the host, after all work submitted so far.
[[nodiscard]] Result<Picture> readPicture(Device& device, VkImage image, VkExtent2D extent, VkFormat format);
[[nodiscard]] inline Result<Picture> readPicture(Device& device, const Image& image) {
    return readPicture(device, image.handle(), image.desc().extent, image.desc().format);
}

} // namespace supple::host
