#include "host/rendering.h"

namespace supple::host {

VkRenderingAttachmentInfo attachment(const Image& image, VkImageLayout layout, VkClearValue clear,
                                     VkAttachmentLoadOp load) {
    return {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
            .imageView = image.view(),
            .imageLayout = layout,
            .loadOp = load,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
            .clearValue = clear};
}

void beginRendering(VkCommandBuffer commands, VkExtent2D extent, std::span<const VkRenderingAttachmentInfo> colors,
                    const VkRenderingAttachmentInfo& depth) {
    const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                               .renderArea = {{0, 0}, extent},
                               .layerCount = 1,
                               .colorAttachmentCount = static_cast<uint32_t>(colors.size()),
                               .pColorAttachments = colors.data(),
                               .pDepthAttachment = &depth};
    vkCmdBeginRendering(commands, &info);
    const VkViewport viewport{0.0f, 0.0f, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0.0f, 1.0f};
    const VkRect2D scissor{{0, 0}, extent};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &scissor);
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
}

} // namespace supple::host
