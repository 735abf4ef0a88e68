// The depth pyramid of a depth picture, by shaders/supple_depth_pyramid.comp: what suppleSetDepthPyramid asks for.
// What fails here ends the process (host/must.h).
#pragma once

#include "host/pipelines.h"

#include <array>
#include <span>

namespace supple::host {

/// Level 0 has half the picture's size: nothing that is drawn is hidden wrongly, and the largest level costs a quarter.
class DepthPyramid {
public:
    explicit DepthPyramid(Device& device);
    ~DepthPyramid();
    DepthPyramid(const DepthPyramid&) = delete;
    DepthPyramid& operator=(const DepthPyramid&) = delete;

    /// For a depth picture of one sample a pixel, with usage SAMPLED; nothing may be in flight.
    void resize(const Image& depth);
    /// The picture in SHADER_READ_ONLY_OPTIMAL, the pyramid in GENERAL, both ready for compute shaders; the barriers
    /// between the levels are in it.
    void record(VkCommandBuffer commands) const;

    [[nodiscard]] VkImage image() const { return image_.handle(); }
    /// With `viewProjection` of the picture.
    [[nodiscard]] SuppleDepthPyramidDesc desc(std::span<const float, 16> viewProjection) const;

private:
    static constexpr uint32_t kMaxLevels = 16;
    [[nodiscard]] VkExtent2D extent(uint32_t level) const;
    void destroyViews();

    Device& device_;
    DescriptorPool pool_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    std::array<VkDescriptorSet, kMaxLevels> sets_{};
    Image image_;
    std::vector<VkImageView> views_; ///< by level
};

} // namespace supple::host
