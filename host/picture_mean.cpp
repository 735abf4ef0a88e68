#include "host/picture_mean.h"

#include "host/rendering.h"

#include <shaders/backdrop_vert.h>
#include <shaders/picture_mean_frag.h>

namespace supple::host {

namespace {

/// Half floats can be blended on every device, and are finer than 8 bits of sRGB.
constexpr VkFormat kMeanFormat = VK_FORMAT_R16G16B16A16_SFLOAT;

constexpr SuppleSyncScope kFetching{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
constexpr SuppleSyncScope kFilling{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr ImageUse kFetched{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, kFetching};
constexpr ImageUse kLookedUp{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                             {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT}};
constexpr ImageUse kBlended{VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                            {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                             VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT}};

template <class T>
Status take(Result<T> made, T& out) {
    if (!made)
        return made.error();
    out = std::move(*made);
    return success();
}

} // namespace

Result<std::unique_ptr<PictureMean>> PictureMean::create(Device& device) {
    std::unique_ptr<PictureMean> mean(new PictureMean(device));
    constexpr VkShaderStageFlags kFragment = VK_SHADER_STAGE_FRAGMENT_BIT;
    if (const Status status = take(createSetLayout(device, {{0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment}}),
                                   mean->setLayout_);
        !status)
        return status.error();
    if (const Status status =
            take(createPipelineLayout(device, {mean->setLayout_}, sizeof(float), kFragment), mean->layout_);
        !status)
        return status.error();
    const GraphicsDesc desc{.name = "picture mean",
                            .layout = mean->layout_,
                            .vertexShader = backdrop_vert,
                            .fragmentShader = picture_mean_frag,
                            .colors = {kMeanFormat},
                            .depthWrite = false,
                            .blend = Blend::over};
    if (const Status status = take(createGraphicsPipeline(device, desc), mean->pipeline_); !status)
        return status.error();
    if (const Status status = take(createSampler(device, VK_FILTER_NEAREST), mean->sampler_); !status)
        return status.error();
    if (const Status status = take(DescriptorPool::create(device, 1), mean->pool_); !status)
        return status.error();
    if (const Status status = take(mean->pool_.allocate(mean->setLayout_), mean->set_); !status)
        return status.error();
    return mean;
}

Status PictureMean::fit(const Image& picture) {
    mean_.reset();
    Result<Image> image =
        device_.createImage({.format = kMeanFormat,
                             .extent = picture.desc().extent,
                             .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
    if (!image)
        return image.error();
    mean_ = std::move(*image);
    pool_.write(set_, {sampledImage(0, picture, sampler_)});
    return success();
}

void PictureMean::add(VkCommandBuffer commands, const Image& picture, uint32_t before, const Image& shown) const {
    imageBarrier(commands, picture, kFetched, kLookedUp);
    imageBarrier(commands, mean_, before == 0 ? ImageUse{VK_IMAGE_LAYOUT_UNDEFINED, kFetching} : kFetched, kBlended);
    blend(commands, before);
    imageBarrier(commands, mean_, kBlended, kFetched);
    imageBarrier(commands, picture, kLookedUp, kFetched);
    stretch(commands, mean_, shown);
}

void PictureMean::blend(VkCommandBuffer commands, uint32_t before) const {
    const VkRenderingAttachmentInfo colors[] = {
        attachment(mean_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, {},
                   before == 0 ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD)};
    const VkRenderingAttachmentInfo noDepth{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    beginRendering(commands, mean_.desc().extent, colors, noDepth);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set_, 0, nullptr);
    const float share = 1.0f / static_cast<float>(before + 1);
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof share, &share);
    vkCmdDraw(commands, 3, 1, 0, 0);
    vkCmdEndRendering(commands);
}

void stretch(VkCommandBuffer commands, const Image& from, const Image& to) {
    const VkExtent2D small = from.desc().extent, large = to.desc().extent;
    // The image may still be in the copy that shows it.
    imageBarrier(commands, to, {VK_IMAGE_LAYOUT_UNDEFINED, kFetching},
                 {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, kFilling});
    VkImageBlit region{};
    region.srcSubresource = region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.srcOffsets[1] = {static_cast<int32_t>(small.width), static_cast<int32_t>(small.height), 1};
    region.dstOffsets[1] = {static_cast<int32_t>(large.width), static_cast<int32_t>(large.height), 1};
    const bool same = small.width == large.width && small.height == large.height;
    vkCmdBlitImage(commands, from.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.handle(),
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, same ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);
    imageBarrier(commands, to, {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, kFilling}, kFetched);
}

} // namespace supple::host
