// The looks of the viewer's pictures, under the validation layer.
#include "tools/supple/view_pictures.h"

#include "tests/tools/validated_device.h"
#include "tools/supple/view_stage.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>

namespace supple::tools {
namespace {

constexpr VkExtent2D kWindowSize{160, 120};
constexpr float kWindowAspect = 160.0f / 120.0f;

class ViewPicturesTest : public testing::Test {
protected:
    void SetUp() override {
        device_ = host::createValidatedDevice();
        ASSERT_TRUE(device_.ok()) << device_.error().message;
        context_ = host::Context::create(**device_);
        ASSERT_TRUE(context_.ok()) << context_.error().message;
        renderer_ = host::SurfaceRenderer::create(**device_, {.quality = host::StudioQuality::interactive(true)});
        ASSERT_TRUE(renderer_.ok()) << renderer_.error().message;
        DrawOptions options;
        options.rate = 4;
        stage_ = ViewStage::create(**context_, **renderer_, options);
        ASSERT_TRUE(stage_.ok()) << stage_.error().message;
        pictures_ = ViewPictures::create(**device_, **renderer_);
        ASSERT_TRUE(pictures_.ok()) << pictures_.error().message;
        ASSERT_TRUE((*pictures_)->fit(kWindowSize, host::kPictureFormat).ok());
    }
    void TearDown() override {
        const std::shared_ptr<const host::ValidationLog> validation = (*device_)->validation();
        pictures_->reset();
        stage_->reset();
        renderer_->reset();
        context_->reset();
        device_->reset();
        EXPECT_EQ(validation->messageCount(), 0u);
    }
    void openPip() {
        const Status status = (*stage_)->open(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb", "0", kWindowAspect);
        ASSERT_TRUE(status.ok()) << status.error().message;
    }
    [[nodiscard]] host::Picture draw(const LookStep& step) {
        const uint64_t number = (*context_)->nextFrame();
        const Status drawn = (*device_)->submitAndWait([&](VkCommandBuffer commands) {
            EXPECT_TRUE((*stage_)->evaluate(commands, number, number - 1).ok());
            EXPECT_TRUE((*pictures_)->record(commands, 0, (*stage_)->scene(kWindowSize), step).ok());
        });
        EXPECT_TRUE(drawn.ok());
        Result<host::Picture> picture = host::readPicture(**device_, (*pictures_)->shown());
        EXPECT_TRUE(picture.ok());
        return *picture;
    }
    /// What a pass of refining draws, by itself.
    [[nodiscard]] host::Picture drawPass(uint32_t pass) {
        Result<host::DrawTarget> target = host::DrawTarget::create(**device_, kWindowSize, (*renderer_)->samples());
        EXPECT_TRUE(target.ok());
        host::Scene scene = (*stage_)->scene(kWindowSize);
        scene.quality = host::StudioQuality::refining();
        scene.pass = pass;
        EXPECT_TRUE((*renderer_)->prepare(scene).ok());
        EXPECT_TRUE(
            (*device_)
                ->submitAndWait([&](VkCommandBuffer commands) { (*renderer_)->record(commands, 0, *target, scene); })
                .ok());
        Result<host::Picture> picture = host::readPicture(**device_, target->color());
        EXPECT_TRUE(picture.ok());
        return *picture;
    }

    Result<std::unique_ptr<host::Device>> device_ = Error{ErrorCode::vulkan, "not made"};
    Result<std::unique_ptr<host::Context>> context_ = Error{ErrorCode::vulkan, "not made"};
    Result<std::unique_ptr<host::SurfaceRenderer>> renderer_ = Error{ErrorCode::vulkan, "not made"};
    Result<std::unique_ptr<ViewStage>> stage_ = Error{ErrorCode::vulkan, "not made"};
    Result<std::unique_ptr<ViewPictures>> pictures_ = Error{ErrorCode::vulkan, "not made"};
};

int farthest(const host::Picture& a, const host::Picture& b) {
    int most = 0;
    for (size_t i = 0; i < a.rgba.size(); ++i)
        most = std::max(most, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
    return most;
}

double meanDifference(const host::Picture& a, const host::Picture& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.rgba.size(); ++i)
        sum += std::abs(int{a.rgba[i]} - int{b.rgba[i]});
    return sum / static_cast<double>(a.rgba.size());
}

TEST_F(ViewPicturesTest, ARefinedPictureIsTheMeanOfItsPassesAndStays) {
    openPip();
    host::PictureAverage average(kWindowSize.width, kWindowSize.height);
    host::Picture refined;
    for (uint32_t pass = 0; pass < 6; ++pass) {
        refined = draw({.kind = LookStep::Kind::refine, .pass = pass});
        average.add(drawPass(pass));
    }
    EXPECT_LE(farthest(refined, average.picture()), 2) << "half floats and their order round";
    EXPECT_GT(farthest(refined, drawPass(0)), 20) << "the passes differ";
    EXPECT_EQ(farthest(refined, draw({.kind = LookStep::Kind::keep})), 0);
}

/// When refining begins, the picture must not jump: fast ones have its shape and brightness.
TEST_F(ViewPicturesTest, FastPicturesAreNearTheStudios) {
    openPip();
    const host::Picture studio = draw({});
    for (uint32_t scale = 0; scale < std::size(kFastScales); ++scale) {
        SCOPED_TRACE(scale);
        const host::Picture fast = draw({.kind = LookStep::Kind::fast, .scaleIndex = scale});
        ASSERT_EQ(fast.rgba.size(), studio.rgba.size());
        EXPECT_LT(meanDifference(fast, studio), 5.0);
        EXPECT_GT(meanDifference(fast, studio), 0.0);
    }
}

/// Without a file there is the backdrop, in all looks.
TEST_F(ViewPicturesTest, AnEmptyStudioIsDrawn) {
    const host::Picture studio = draw({});
    EXPECT_LE(farthest(studio, draw({.kind = LookStep::Kind::fast, .scaleIndex = 0})), 4) << "a floor without shadows";
    EXPECT_GT(studio.pixel(80, 60)[0], studio.pixel(0, 119)[0]) << "lighter in the middle";
}

} // namespace
} // namespace supple::tools
