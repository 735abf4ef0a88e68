#include "tools/supple/view_pictures.h"

#include <algorithm>
#include <cmath>

namespace supple::tools {

Result<std::unique_ptr<ViewPictures>> ViewPictures::create(host::Device& device, host::SurfaceRenderer& renderer) {
    std::unique_ptr<ViewPictures> pictures(new ViewPictures(device, renderer));
    Result<std::unique_ptr<host::PictureMean>> mean = host::PictureMean::create(device);
    if (!mean)
        return mean.error();
    pictures->mean_ = std::move(*mean);
    return pictures;
}

Status ViewPictures::fit(VkExtent2D extent, VkFormat format) {
    for (size_t i = 0; i < std::size(kFastScales); ++i) {
        const auto scaled = [&](uint32_t side) {
            return std::max(1u, static_cast<uint32_t>(std::lround(static_cast<float>(side) * kFastScales[i])));
        };
        Result<host::DrawTarget> target = host::DrawTarget::create(
            device_, {scaled(extent.width), scaled(extent.height)}, renderer_.samples(), format);
        if (!target)
            return target.error();
        (i == 0 ? full_ : smaller_[i]) = std::move(*target);
    }
    Result<host::Image> mixed =
        device_.createImage({.format = format,
                             .extent = extent,
                             .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                                      VK_IMAGE_USAGE_SAMPLED_BIT}); // images have views
    if (!mixed)
        return mixed.error();
    mixed_ = std::move(*mixed);
    shown_ = &full_.color();
    return mean_->fit(full_.color());
}

Status ViewPictures::record(VkCommandBuffer commands, uint32_t slot, host::Scene scene, const LookStep& step) {
    const host::DrawTarget* target = &full_;
    switch (step.kind) {
    case LookStep::Kind::keep:
        return success();
    case LookStep::Kind::studio:
        break;
    case LookStep::Kind::fast:
        scene.quality = host::StudioQuality::fast();
        scene.coarse = scene.view == host::shared::kViewShaded;
        scene.pixelScale *= kFastScales[step.scaleIndex];
        target = step.scaleIndex == 0 ? &full_ : &smaller_[step.scaleIndex];
        break;
    case LookStep::Kind::refine:
        scene.quality = host::StudioQuality::refining();
        scene.pass = step.pass;
        break;
    }
    if (const Status status = renderer_.prepare(scene); !status)
        return status.error();
    renderer_.record(commands, slot, *target, scene);
    shown_ = &full_.color();
    if (step.kind == LookStep::Kind::refine)
        mean_->add(commands, full_.color(), step.pass, mixed_);
    else if (target != &full_)
        host::stretch(commands, target->color(), mixed_);
    else
        return success();
    shown_ = &mixed_;
    return success();
}

} // namespace supple::tools
