#include "host/depth_pyramid.h"

#include "host/must.h"

#include "shaders/supple_depth_pyramid_comp.h"

#include <algorithm>
#include <bit>

namespace supple::host {

DepthPyramid::DepthPyramid(Device& device) : device_(device), pool_(must(DescriptorPool::create(device, kMaxLevels))) {
    const VkDescriptorSetLayout setLayout =
        must(createSetLayout(device, {{0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, VK_SHADER_STAGE_COMPUTE_BIT},
                                      {1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, VK_SHADER_STAGE_COMPUTE_BIT}}));
    layout_ = must(createPipelineLayout(device, {setLayout}, sizeof(uint32_t), VK_SHADER_STAGE_COMPUTE_BIT));
    pipeline_ = must(createComputePipeline(device, layout_, supple_depth_pyramid_comp));
    for (VkDescriptorSet& set : sets_)
        set = must(pool_.allocate(setLayout));
}

DepthPyramid::~DepthPyramid() {
    destroyViews();
}

void DepthPyramid::destroyViews() {
    for (const VkImageView view : views_)
        vkDestroyImageView(device_.handle(), view, nullptr);
    views_.clear();
}

VkExtent2D DepthPyramid::extent(uint32_t level) const {
    const VkExtent2D whole = image_.desc().extent;
    return {std::max(whole.width >> level, 1u), std::max(whole.height >> level, 1u)};
}

void DepthPyramid::resize(const Image& depth) {
    destroyViews();
    const VkExtent2D half{(depth.desc().extent.width + 1) / 2, (depth.desc().extent.height + 1) / 2};
    const auto levels = static_cast<uint32_t>(std::bit_width(std::max(half.width, half.height)));
    image_ = must(device_.createImage({.format = VK_FORMAT_R32_SFLOAT,
                                       .extent = half,
                                       .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT,
                                       .mipLevels = std::min(levels, kMaxLevels)}));
    for (uint32_t level = 0; level < image_.desc().mipLevels; ++level) {
        const VkImageViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                         .image = image_.handle(),
                                         .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                         .format = VK_FORMAT_R32_SFLOAT,
                                         .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, level, 1, 0, 1}};
        must(vkCreateImageView(device_.handle(), &info, nullptr, &views_.emplace_back()), "vkCreateImageView");
        const VkDescriptorImageInfo from{VK_NULL_HANDLE, level == 0 ? depth.view() : views_[level - 1],
                                         level == 0 ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
                                                    : VK_IMAGE_LAYOUT_GENERAL};
        pool_.write(sets_[level], {{0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, from},
                                   {1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
                                    VkDescriptorImageInfo{VK_NULL_HANDLE, views_[level], VK_IMAGE_LAYOUT_GENERAL}}});
    }
}

void DepthPyramid::record(VkCommandBuffer commands) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
    const uint32_t reversed = 0;
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof reversed, &reversed);
    for (uint32_t level = 0; level < views_.size(); ++level) {
        if (level > 0) {
            const VkMemoryBarrier2 barrier{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                           .srcStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                           .srcAccessMask = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                                           .dstStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                           .dstAccessMask = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
            const VkDependencyInfo dependency{
                .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
            vkCmdPipelineBarrier2(commands, &dependency);
        }
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &sets_[level], 0, nullptr);
        const VkExtent2D size = extent(level);
        vkCmdDispatch(commands, (size.width + 7) / 8, (size.height + 7) / 8, 1);
    }
}

SuppleDepthPyramidDesc DepthPyramid::desc(std::span<const float, 16> viewProjection) const {
    auto desc = supple::sized<SuppleDepthPyramidDesc>();
    desc.imageView = image_.view();
    desc.layout = VK_IMAGE_LAYOUT_GENERAL;
    desc.width = image_.desc().extent.width;
    desc.height = image_.desc().extent.height;
    desc.mipLevels = image_.desc().mipLevels;
    std::copy(viewProjection.begin(), viewProjection.end(), desc.viewProjection);
    return desc;
}

} // namespace supple::host
