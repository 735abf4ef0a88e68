// A stage for tests of pictures: one device, and a renderer and a target without and with multisampling.
#pragma once

#include "host/context.h"
#include "host/draw_target.h"
#include "host/surface_renderer.h"
#include "tests/tools/validated_device.h"

#include <gtest/gtest.h>
#include <memory>
#include <utility>

namespace supple::host {

inline constexpr VkExtent2D kStageSize{240, 200};

/// All tests of a suite share it. The validation layer must stay silent.
class TwoRenderers : public testing::Test {
protected:
    static void SetUpTestSuite() {
        Result<std::unique_ptr<Device>> device = createValidatedDevice();
        ASSERT_TRUE(device.ok()) << device.error().message;
        device_ = std::move(*device);
        Result<std::unique_ptr<Context>> context = Context::create(*device_);
        ASSERT_TRUE(context.ok()) << context.error().message;
        context_ = std::move(*context);
        for (const bool multisample : {false, true}) {
            StudioQuality quality = StudioQuality::interactive(true);
            quality.multisample = multisample;
            Result<std::unique_ptr<SurfaceRenderer>> renderer = SurfaceRenderer::create(*device_, {.quality = quality});
            ASSERT_TRUE(renderer.ok()) << renderer.error().message;
            renderers_[multisample] = std::move(*renderer);
            Result<DrawTarget> target = DrawTarget::create(*device_, kStageSize, renderers_[multisample]->samples());
            ASSERT_TRUE(target.ok()) << target.error().message;
            targets_[multisample] = std::move(*target);
        }
    }

    static void TearDownTestSuite() {
        for (const size_t i : {0u, 1u}) {
            targets_[i] = {};
            renderers_[i].reset();
        }
        context_.reset();
        if (device_ == nullptr)
            return;
        const std::shared_ptr<const ValidationLog> validation = device_->validation();
        device_.reset();
        EXPECT_EQ(validation->messageCount(), 0u);
    }

    void SetUp() override { ASSERT_NE(renderers_[1], nullptr); }
    void TearDown() override { EXPECT_EQ(device_->validation()->messageCount(), 0u); }

    inline static std::unique_ptr<Device> device_;
    inline static std::unique_ptr<Context> context_;
    inline static std::unique_ptr<SurfaceRenderer> renderers_[2]; ///< by multisampling
    inline static DrawTarget targets_[2];
};

} // namespace supple::host
