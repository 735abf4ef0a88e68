// The mean of a number of pictures in linear light, on the device: a picture that becomes better while it is shown.
#pragma once

#include "host/pipelines.h"

#include <memory>

namespace supple::host {

class PictureMean {
public:
    [[nodiscard]] static Result<std::unique_ptr<PictureMean>> create(Device& device);
    PictureMean(const PictureMean&) = delete;
    PictureMean& operator=(const PictureMean&) = delete;

    /// What the pictures are drawn into, which must stay and be SAMPLED. No frame that uses the mean may be pending.
    [[nodiscard]] Status fit(const Image& picture);
    /// Takes the picture as it is now, in TRANSFER_SRC_OPTIMAL and visible to copies, in which it stays; `before` are
    /// in the mean already. `shown`, a TRANSFER_DST of the same size, becomes the mean and is left likewise.
    void add(VkCommandBuffer commands, const Image& picture, uint32_t before, const Image& shown) const;

private:
    explicit PictureMean(Device& device) : device_(device) {}
    void blend(VkCommandBuffer commands, uint32_t before) const;

    Device& device_;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    VkSampler sampler_ = VK_NULL_HANDLE;
    DescriptorPool pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    Image mean_;
};

/// Copies one image over all of another, smoothly where their sizes differ. The first is in TRANSFER_SRC_OPTIMAL; both
/// are left in it, visible to copies.
void stretch(VkCommandBuffer commands, const Image& from, const Image& to);

} // namespace supple::host
