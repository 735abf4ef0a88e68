#include "host/draw_target.h"

#include <cstring>
#include <utility>

namespace supple::host {

VkSampleCountFlagBits pictureSamples(const Device& device, bool multisample) {
    const VkPhysicalDeviceLimits& limits = device.properties().limits;
    const VkSampleCountFlags both = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
    return multisample && (both & VK_SAMPLE_COUNT_4_BIT) != 0 ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT;
}

Result<DrawTarget> DrawTarget::create(Device& device, VkExtent2D extent, VkSampleCountFlagBits samples,
                                      VkFormat format) {
    const uint32_t limit = device.properties().limits.maxImageDimension2D;
    if (extent.width == 0 || extent.height == 0 || extent.width > limit || extent.height > limit)
        return Error{ErrorCode::limit, "a picture of " + std::to_string(extent.width) + "x" +
                                           std::to_string(extent.height) + " pixels; the device draws 1 to " +
                                           std::to_string(limit) + " a side"};
    DrawTarget target;
    const auto make = [&](Image& image, const ImageDesc& desc) -> Status {
        Result<Image> made = device.createImage(desc);
        if (!made)
            return made.error();
        image = std::move(*made);
        return success();
    };
    const ImageDesc color{.format = format,
                          .extent = extent,
                          .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                   VK_IMAGE_USAGE_SAMPLED_BIT};
    if (const Status status = make(target.color_, color); !status)
        return status.error();
    const ImageDesc depth{.format = kDepthFormat,
                          .extent = extent,
                          .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                          .aspect = VK_IMAGE_ASPECT_DEPTH_BIT,
                          .samples = samples};
    if (const Status status = make(target.depth_, depth); !status)
        return status.error();
    if (samples != VK_SAMPLE_COUNT_1_BIT) {
        const ImageDesc multisampled{
            .format = format, .extent = extent, .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, .samples = samples};
        if (const Status status = make(target.multisampled_, multisampled); !status)
            return status.error();
    }
    return target;
}

Result<Picture> readPicture(Device& device, VkImage image, VkExtent2D extent, VkFormat format) {
    Picture picture{extent.width, extent.height, {}};
    picture.rgba.resize(size_t{extent.width} * extent.height * 4);
    Result<Buffer> staging =
        device.createBuffer(picture.rgba.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::readback);
    if (!staging)
        return staging.error();
    const Status status = device.submitAndWait([&](VkCommandBuffer commands) {
        memoryBarrier(commands, {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT},
                      {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT});
        VkBufferImageCopy region{};
        region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        region.imageExtent = {extent.width, extent.height, 1};
        vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, staging->handle(), 1, &region);
        memoryBarrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                      {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    });
    if (!status)
        return status.error();
    std::memcpy(picture.rgba.data(), staging->mapped(), picture.rgba.size());
    const bool blueFirst = format == VK_FORMAT_B8G8R8A8_SRGB || format == VK_FORMAT_B8G8R8A8_UNORM;
    for (size_t i = 0; i < picture.rgba.size(); i += 4) {
        if (blueFirst)
            std::swap(picture.rgba[i], picture.rgba[i + 2]);
        picture.rgba[i + 3] = 255;
    }
    return picture;
}

} // namespace supple::host
