#include "host/texture.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace supple::host {

namespace {

VkFormat formatOf(TextureKind kind) {
    return kind == TextureKind::color ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM;
}

bool canBlit(const Device& device, VkFormat format) {
    constexpr VkFormatFeatureFlags kNeeded = VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_BLIT_DST_BIT |
                                             VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(device.physicalDevice(), format, &properties);
    return (properties.optimalTilingFeatures & kNeeded) == kNeeded;
}

/// Fills level after level from the one before and hands the whole image to the shaders.
void recordMipLevels(VkCommandBuffer commands, const Image& image) {
    const ImageUse written{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT}};
    const ImageUse source{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                          {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT}};
    auto width = static_cast<int32_t>(image.desc().extent.width);
    auto height = static_cast<int32_t>(image.desc().extent.height);
    for (uint32_t level = 1; level <= image.desc().mipLevels; ++level) {
        imageBarrier(commands, image.handle(), {VK_IMAGE_ASPECT_COLOR_BIT, level - 1, 1, 0, 1}, written, source);
        if (level == image.desc().mipLevels)
            break;
        VkImageBlit blit{};
        blit.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level - 1, 0, 1};
        blit.srcOffsets[1] = {width, height, 1};
        width = std::max(width / 2, 1);
        height = std::max(height / 2, 1);
        blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1};
        blit.dstOffsets[1] = {width, height, 1};
        vkCmdBlitImage(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image.handle(),
                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit, VK_FILTER_LINEAR);
    }
    imageBarrier(commands, image, source,
                 {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                  {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT}});
}

} // namespace

Result<Image> uploadTexture(Device& device, const Picture& picture, TextureKind kind) {
    const uint32_t side = std::max(picture.width, picture.height);
    if (const uint32_t limit = device.properties().limits.maxImageDimension2D; side > limit)
        return Error{ErrorCode::limit, "a texture of " + std::to_string(side) + " pixels a side; the device takes " +
                                           std::to_string(limit)};
    ImageDesc desc{.format = formatOf(kind),
                   .extent = {picture.width, picture.height},
                   .usage =
                       VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT};
    if (kind != TextureKind::tiles && canBlit(device, desc.format))
        desc.mipLevels = static_cast<uint32_t>(std::bit_width(side));
    Result<Image> image = device.createImage(desc);
    if (!image)
        return image.error();
    Result<Buffer> staging =
        device.createBuffer(picture.rgba.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::upload);
    if (!staging)
        return staging.error();
    std::memcpy(staging->mapped(), picture.rgba.data(), picture.rgba.size());
    const Status status = device.submitAndWait([&](VkCommandBuffer commands) {
        imageBarrier(commands, *image, {VK_IMAGE_LAYOUT_UNDEFINED, {}},
                     {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                      {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT}});
        VkBufferImageCopy region{};
        region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        region.imageExtent = {picture.width, picture.height, 1};
        vkCmdCopyBufferToImage(commands, staging->handle(), image->handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                               &region);
        recordMipLevels(commands, *image);
    });
    if (!status)
        return status.error();
    return image;
}

} // namespace supple::host
