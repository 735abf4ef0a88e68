#include "picture.h"

namespace qt_quick {

namespace {

constexpr uint32_t kSunTexels = 2048;
constexpr SuppleSyncScope kColorWrites{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                       VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
constexpr SuppleSyncScope kDepthTests{
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
constexpr SuppleSyncScope kReads{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
constexpr VkImageSubresourceRange kDepthRange{VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};

VkRenderingAttachmentInfo depthAttachment(const Image& image, VkAttachmentStoreOp store) {
    VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = image.view;
    info.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    info.storeOp = store;
    info.clearValue.depthStencil.depth = 1.0f;
    return info;
}

void beginRendering(VkCommandBuffer commands, VkExtent2D extent, const VkRenderingAttachmentInfo* color,
                    const VkRenderingAttachmentInfo& depth) {
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = extent;
    info.layerCount = 1;
    info.colorAttachmentCount = color != nullptr ? 1 : 0;
    info.pColorAttachments = color;
    info.pDepthAttachment = &depth;
    vkCmdBeginRendering(commands, &info);
    const VkViewport viewport{0.0f, 0.0f, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0.0f, 1.0f};
    const VkRect2D scissor{{0, 0}, extent};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &scissor);
}

} // namespace

Picture::Picture(const Gpu& gpu, VkExtent2D extent) : gpu_(gpu), extent_(extent) {
    samples_ = createImage(gpu, {kColorFormat, extent, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, kSamples});
    depth_ = createImage(gpu, {kDepthFormat, extent, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, kSamples});
    shown_ = createImage(gpu, {kColorFormat, extent, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT});
}

void Picture::destroy() {
    for (const Image& image : {samples_, depth_, shown_})
        destroyImage(gpu_, image);
}

void Picture::begin(VkCommandBuffer commands) const {
    // What was there is drawn over. The scene graph's reads of the last frame end first.
    transition(commands, samples_.image, kColorWrites, VK_IMAGE_LAYOUT_UNDEFINED, kColorWrites,
               VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    transition(commands, shown_.image, kReads, VK_IMAGE_LAYOUT_UNDEFINED, kColorWrites,
               VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    transition(commands, depth_.image, kDepthTests, VK_IMAGE_LAYOUT_UNDEFINED, kDepthTests,
               VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kDepthRange);
    VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    color.imageView = samples_.view;
    color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    color.resolveImageView = shown_.view;
    color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE; // the backdrop fills it
    color.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    beginRendering(commands, extent_, &color, depthAttachment(depth_, VK_ATTACHMENT_STORE_OP_DONT_CARE));
}

void Picture::end(VkCommandBuffer commands) const {
    vkCmdEndRendering(commands);
    transition(commands, shown_.image, kColorWrites, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, kReads,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

SunMap::SunMap(const Gpu& gpu) : gpu_(gpu) {
    depth_ = createImage(gpu, {kDepthFormat,
                               {kSunTexels, kSunTexels},
                               VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT});
    VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    info.magFilter = info.minFilter = VK_FILTER_LINEAR;
    info.addressModeU = info.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
    info.borderColor = VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE; // nothing out there hides the sun
    info.compareEnable = VK_TRUE;
    info.compareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
    must(vkCreateSampler(gpu.device, &info, nullptr, &sampler_), "vkCreateSampler");
}

void SunMap::destroy() {
    vkDestroySampler(gpu_.device, sampler_, nullptr);
    destroyImage(gpu_, depth_);
}

void SunMap::begin(VkCommandBuffer commands) const {
    transition(commands, depth_.image, kReads, VK_IMAGE_LAYOUT_UNDEFINED, kDepthTests,
               VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kDepthRange);
    beginRendering(commands, {kSunTexels, kSunTexels}, nullptr, depthAttachment(depth_, VK_ATTACHMENT_STORE_OP_STORE));
}

void SunMap::end(VkCommandBuffer commands) const {
    vkCmdEndRendering(commands);
    transition(commands, depth_.image, kDepthTests, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kReads,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, kDepthRange);
}

} // namespace qt_quick
