// The pictures behind the viewer's window, in the looks of view_look.h.
#pragma once

#include "host/picture_mean.h"
#include "host/surface_renderer.h"
#include "tools/supple/view_look.h"

#include <iterator>
#include <memory>

namespace supple::tools {

class ViewPictures {
public:
    [[nodiscard]] static Result<std::unique_ptr<ViewPictures>> create(host::Device& device,
                                                                      host::SurfaceRenderer& renderer);
    /// No frame may be pending.
    [[nodiscard]] Status fit(VkExtent2D extent, VkFormat format);
    /// `slot`: see SurfaceRenderer::record.
    [[nodiscard]] Status record(VkCommandBuffer commands, uint32_t slot, host::Scene scene, const LookStep& step);
    /// In TRANSFER_SRC_OPTIMAL, visible to copies.
    [[nodiscard]] const host::Image& shown() const { return *shown_; }

private:
    ViewPictures(host::Device& device, host::SurfaceRenderer& renderer) : device_(device), renderer_(renderer) {}

    host::Device& device_;
    host::SurfaceRenderer& renderer_;
    host::DrawTarget full_;
    host::DrawTarget smaller_[std::size(kFastScales)]; ///< all but the first
    host::Image mixed_;                                ///< what is made of other pictures: stretched, averaged
    const host::Image* shown_ = nullptr;
    std::unique_ptr<host::PictureMean> mean_;
};

} // namespace supple::tools
