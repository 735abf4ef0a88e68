// How drawing into images begins.
#pragma once

#include "host/device.h"

#include <span>

namespace supple::host {

/// Stored; cleared before, unless `load` says otherwise.
VkRenderingAttachmentInfo attachment(const Image& image, VkImageLayout layout, VkClearValue clear = {},
                                     VkAttachmentLoadOp load = VK_ATTACHMENT_LOAD_OP_CLEAR);

/// With viewport and scissor over all of it; nothing is culled.
void beginRendering(VkCommandBuffer commands, VkExtent2D extent, std::span<const VkRenderingAttachmentInfo> colors,
                    const VkRenderingAttachmentInfo& depth);

} // namespace supple::host
