// A small picture that tests draw into with shaders of their own.
#pragma once

#include "host/draw_target.h"
#include "host/pipelines.h"
#include "host/rendering.h"
#include "tests/support/logged_context.h"

#include <functional>
#include <gtest/gtest.h>
#include <utility>

namespace supple::test {

class Canvas {
public:
    static constexpr uint32_t kSide = 256;

    explicit Canvas(host::Device& device)
        : device_(device),
          target_(std::move(*host::DrawTarget::create(device, {kSide, kSide}, VK_SAMPLE_COUNT_1_BIT))) {}

    /// For a pipeline that draws into it; layout and shaders are the caller's.
    [[nodiscard]] static host::GraphicsDesc pipelineDesc(const char* name) {
        host::GraphicsDesc desc;
        desc.name = name;
        desc.colors = {host::kPictureFormat};
        desc.depth = host::kDepthFormat;
        return desc;
    }
    [[nodiscard]] static host::Picture blank() { return host::Picture::blank(kSide, kSide); }
    /// What `body` draws, which is recorded while the canvas is the target. Blank, and a failure, if that fails.
    [[nodiscard]] host::Picture draw(const std::function<void(VkCommandBuffer)>& body) {
        constexpr VkImageLayout kColor = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                kDepth = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
        const Status drawn = device_.submitAndWait([&](VkCommandBuffer commands) {
            const SuppleSyncScope any = kAnyUse;
            host::imageBarrier(commands, target_.color(), {VK_IMAGE_LAYOUT_UNDEFINED, any}, {kColor, any});
            host::imageBarrier(commands, target_.depth(), {VK_IMAGE_LAYOUT_UNDEFINED, any}, {kDepth, any});
            const VkRenderingAttachmentInfo color = host::attachment(target_.color(), kColor);
            host::beginRendering(commands, target_.extent(), {&color, 1},
                                 host::attachment(target_.depth(), kDepth, {.depthStencil = {1.0f, 0}}));
            body(commands);
            vkCmdEndRendering(commands);
            host::imageBarrier(commands, target_.color(), {kColor, any}, {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, any});
        });
        EXPECT_TRUE(drawn.ok());
        Result<host::Picture> picture = host::readPicture(device_, target_.color());
        EXPECT_TRUE(picture.ok());
        return picture.ok() ? std::move(*picture) : blank();
    }

private:
    host::Device& device_;
    host::DrawTarget target_;
};

} // namespace supple::test
