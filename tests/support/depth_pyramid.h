// A depth pyramid on the device, made by shaders/supple_depth_pyramid.comp as a host would.
#pragma once

#include "gpu/pipeline.h"
#include "host/device.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace supple::test {

/// A picture of depths, row by row.
struct DepthPicture {
    uint32_t width = 0, height = 0;
    bool reversed = false;
    std::vector<float> depths;
};

class DepthPyramid {
public:
    /// Level 0 is width x height; with all levels there can be. Null, with a failure recorded, when it could not be
    /// made.
    static std::unique_ptr<DepthPyramid> create(host::Device& host, const DepthPicture& picture, uint32_t width,
                                                uint32_t height);
    ~DepthPyramid();
    DepthPyramid(const DepthPyramid&) = delete;
    DepthPyramid& operator=(const DepthPyramid&) = delete;

    [[nodiscard]] uint32_t levels() const { return static_cast<uint32_t>(views_.size()); }
    [[nodiscard]] VkExtent2D extent(uint32_t level) const;
    /// Of a level, as the device has it.
    [[nodiscard]] std::vector<float> read(uint32_t level);
    /// Ready for compute shaders to read, in the layout GENERAL.
    [[nodiscard]] VkImageView view() const { return image_.view(); }
    [[nodiscard]] SuppleDepthPyramidDesc desc(const std::array<float, 16>& viewProjection) const;

private:
    explicit DepthPyramid(host::Device& host) : host_(host) {}
    void make(const DepthPicture& picture);

    host::Device& host_;
    bool reversed_ = false;
    host::Image image_;
    std::vector<VkImageView> views_; ///< by level
};

} // namespace supple::test
