#include "tests/support/depth_pyramid.h"

#include "shaders/supple_depth_pyramid_comp.h"
#include "tests/support/gpu_surface.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <gtest/gtest.h>

namespace supple::test {

namespace {

constexpr host::ImageUse kWritten{VK_IMAGE_LAYOUT_GENERAL,
                                  {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}};
constexpr host::ImageUse kRead{VK_IMAGE_LAYOUT_GENERAL,
                               {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT}};
constexpr host::ImageUse kSampled{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, kRead.scope};
constexpr host::ImageUse kCopied{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                 {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT}};
constexpr host::ImageUse kUploaded{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                   {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT}};

VkImageSubresourceRange level(uint32_t index) {
    return {VK_IMAGE_ASPECT_COLOR_BIT, index, 1, 0, 1};
}

} // namespace

std::unique_ptr<DepthPyramid> DepthPyramid::create(host::Device& host, const DepthPicture& picture, uint32_t width,
                                                   uint32_t height) {
    auto pyramid = std::unique_ptr<DepthPyramid>(new DepthPyramid(host));
    pyramid->reversed_ = picture.reversed;
    host::ImageDesc desc;
    desc.format = VK_FORMAT_R32_SFLOAT;
    desc.extent = {width, height};
    desc.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    desc.mipLevels = static_cast<uint32_t>(std::bit_width(std::max(width, height)));
    Result<host::Image> image = host.createImage(desc);
    if (!image) {
        ADD_FAILURE() << image.error().message;
        return nullptr;
    }
    pyramid->image_ = std::move(*image);
    for (uint32_t l = 0; l < desc.mipLevels; ++l) {
        VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
        info.image = pyramid->image_.handle();
        info.viewType = VK_IMAGE_VIEW_TYPE_2D;
        info.format = desc.format;
        info.subresourceRange = level(l);
        EXPECT_EQ(vkCreateImageView(host.handle(), &info, nullptr, &pyramid->views_.emplace_back()), VK_SUCCESS);
    }
    pyramid->make(picture);
    return pyramid;
}

DepthPyramid::~DepthPyramid() {
    for (const VkImageView view : views_) {
        vkDestroyImageView(host_.handle(), view, nullptr);
    }
}

VkExtent2D DepthPyramid::extent(uint32_t level) const {
    const VkExtent2D whole = image_.desc().extent;
    return {std::max(whole.width >> level, 1u), std::max(whole.height >> level, 1u)};
}

void DepthPyramid::make(const DepthPicture& picture) {
    host::ImageDesc desc;
    desc.format = VK_FORMAT_R32_SFLOAT;
    desc.extent = {picture.width, picture.height};
    desc.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    Result<host::Image> source = host_.createImage(desc);
    Result<host::Buffer> staging = host_.uploadBuffer(picture.depths.data(), picture.depths.size() * sizeof(float),
                                                      VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    ASSERT_TRUE(source.ok() && staging.ok());

    gpu::DeviceDesc deviceDesc;
    deviceDesc.instance = host_.instance();
    deviceDesc.physicalDevice = host_.physicalDevice();
    deviceDesc.device = host_.handle();
    deviceDesc.queueFamily = deviceDesc.drawQueueFamily = host_.queueFamily();
    deviceDesc.getInstanceProcAddr = host_.getInstanceProcAddr();
    Result<gpu::Device> device = gpu::Device::create(deviceDesc);
    ASSERT_TRUE(device.ok());
    const gpu::Binding bindings[] = {{0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE}, {1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}};
    Result<gpu::ComputeLayout> layout = gpu::ComputeLayout::create(*device, bindings, sizeof(uint32_t), "test pyramid");
    ASSERT_TRUE(layout.ok());
    Result<gpu::PipelineHandle> pipeline =
        gpu::createComputePipeline(*device, layout->pipelineLayout.get(),
                                   {supple_depth_pyramid_comp, supple_depth_pyramid_comp}, {}, "test pyramid");
    Result<gpu::DescriptorPoolHandle> pool = gpu::createDescriptorPool(*device, *layout, levels(), "test pyramid");
    ASSERT_TRUE(pipeline.ok() && pool.ok());
    std::vector<VkDescriptorSet> sets;
    for (uint32_t l = 0; l < levels(); ++l) {
        const Result<VkDescriptorSet> set = gpu::allocateSet(*device, *layout, pool->get(), "test pyramid");
        ASSERT_TRUE(set.ok());
        sets.push_back(*set);
        const VkDescriptorImageInfo infos[] = {
            {VK_NULL_HANDLE, l == 0 ? source->view() : views_[l - 1], l == 0 ? kSampled.layout : kRead.layout},
            {VK_NULL_HANDLE, views_[l], VK_IMAGE_LAYOUT_GENERAL}};
        for (uint32_t b = 0; b < 2; ++b) {
            VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
            write.dstSet = *set;
            write.dstBinding = b;
            write.descriptorCount = 1;
            write.descriptorType = bindings[b].type;
            write.pImageInfo = &infos[b];
            vkUpdateDescriptorSets(host_.handle(), 1, &write, 0, nullptr);
        }
    }
    const uint32_t reversed = picture.reversed ? 1 : 0;
    const Status done = host_.submitAndWait([&](VkCommandBuffer commands) {
        host::imageBarrier(commands, *source, {VK_IMAGE_LAYOUT_UNDEFINED, {}}, kUploaded);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        copy.imageExtent = {picture.width, picture.height, 1};
        vkCmdCopyBufferToImage(commands, staging->handle(), source->handle(), kUploaded.layout, 1, &copy);
        host::imageBarrier(commands, *source, kUploaded, kSampled);
        host::imageBarrier(commands, image_, {VK_IMAGE_LAYOUT_UNDEFINED, {}}, kWritten);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline->get());
        for (uint32_t l = 0; l < levels(); ++l) {
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout->pipelineLayout.get(), 0, 1,
                                    &sets[l], 0, nullptr);
            vkCmdPushConstants(commands, layout->pipelineLayout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(reversed),
                               &reversed);
            const VkExtent2D size = extent(l);
            vkCmdDispatch(commands, (size.width + 7) / 8, (size.height + 7) / 8, 1);
            host::imageBarrier(commands, image_.handle(), level(l), kWritten, kRead);
        }
    });
    EXPECT_TRUE(done.ok());
}

std::vector<float> DepthPyramid::read(uint32_t index) {
    const VkExtent2D size = extent(index);
    std::vector<float> texels(size_t{size.width} * size.height);
    Result<host::Buffer> staging =
        host_.createBuffer(texels.size() * sizeof(float), VK_BUFFER_USAGE_TRANSFER_DST_BIT, host::MemoryKind::readback);
    EXPECT_TRUE(staging.ok());
    const Status done = host_.submitAndWait([&](VkCommandBuffer commands) {
        host::imageBarrier(commands, image_.handle(), level(index), kWritten, kCopied);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, index, 0, 1};
        copy.imageExtent = {size.width, size.height, 1};
        vkCmdCopyImageToBuffer(commands, image_.handle(), kCopied.layout, staging->handle(), 1, &copy);
        host::imageBarrier(commands, image_.handle(), level(index), kCopied, kRead);
        host::memoryBarrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                            {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    });
    EXPECT_TRUE(done.ok());
    std::memcpy(texels.data(), staging->mapped(), texels.size() * sizeof(float));
    return texels;
}

SuppleDepthPyramidDesc DepthPyramid::desc(const std::array<float, 16>& viewProjection) const {
    SuppleDepthPyramidDesc desc{};
    desc.structSize = sizeof(desc);
    desc.flags = reversed_ ? SUPPLE_DEPTH_REVERSED : 0;
    desc.imageView = view();
    desc.layout = VK_IMAGE_LAYOUT_GENERAL;
    desc.width = image_.desc().extent.width;
    desc.height = image_.desc().extent.height;
    desc.mipLevels = levels();
    std::copy(viewProjection.begin(), viewProjection.end(), desc.viewProjection);
    return desc;
}

} // namespace supple::test
