#include "picture.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#include <vector>

namespace sample {

void copyPicture(VkCommandBuffer commands, const Image& picture, const Buffer& readback) {
    const VkExtent2D extent = picture.desc().extent;
    const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                   .imageExtent = {extent.width, extent.height, 1}};
    vkCmdCopyImageToBuffer(commands, picture.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, readback.handle(), 1,
                           &region);
    const VkMemoryBarrier2 toHost{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                  .srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                                  .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                  .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
                                  .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT};
    const VkDependencyInfo dependency{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &toHost};
    vkCmdPipelineBarrier2(commands, &dependency);
}

void writePng(const std::string& path, uint32_t width, uint32_t height, const void* rgba) {
    const auto* from = static_cast<const unsigned char*>(rgba);
    std::vector<unsigned char> rgb;
    rgb.reserve(std::size_t{3} * width * height);
    for (std::size_t i = 0; i < std::size_t{width} * height; ++i)
        rgb.insert(rgb.end(), from + 4 * i, from + 4 * i + 3);
    if (stbi_write_png(path.c_str(), static_cast<int>(width), static_cast<int>(height), 3, rgb.data(),
                       static_cast<int>(3 * width)) == 0)
        fail(path + " cannot be written");
}

} // namespace sample
