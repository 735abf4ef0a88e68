// What a click in the viewer meets, without its window.
#include "tools/supple/view_pick.h"

#include "tests/tools/validated_device.h"

#include <gtest/gtest.h>

namespace supple::tools {
namespace {

constexpr float kPickAspect = 4.0f / 3.0f;

/// Where a point is in the picture.
glm::vec2 placeIn(const ViewStage& stage, const glm::vec3& point) {
    const glm::vec4 at = stage.camera().projection(kPickAspect, 1.0f) * stage.camera().view() * glm::vec4(point, 1.0f);
    return {stage.surfaceShift() + 0.5f + 0.5f * at.x / at.w, 0.5f - 0.5f * at.y / at.w};
}

TEST(ViewPickTest, TellsWhatIsSeenThere) {
    Result<std::unique_ptr<host::Device>> device = host::createValidatedDevice();
    ASSERT_TRUE(device.ok()) << device.error().message;
    {
        Result<std::unique_ptr<host::Context>> context = host::Context::create(**device, {.framesInFlight = 2});
        ASSERT_TRUE(context.ok()) << context.error().message;
        Result<std::unique_ptr<host::SurfaceRenderer>> renderer = host::SurfaceRenderer::create(
            **device, {.quality = host::StudioQuality::interactive(true), .framesInFlight = 2});
        ASSERT_TRUE(renderer.ok()) << renderer.error().message;
        DrawOptions options;
        options.rate = 2;
        Result<std::unique_ptr<ViewStage>> opened = ViewStage::create(**context, **renderer, options);
        ASSERT_TRUE(opened.ok()) << opened.error().message;
        ViewStage& stage = **opened;
        const Status status = stage.open(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip_quads.glb", "walk", kPickAspect);
        ASSERT_TRUE(status.ok()) << status.error().message;
        for (const bool split : {false, true}) {
            stage.settings.split = split;
            const Result<std::vector<glm::vec3>> surface = stage.group().readSurface();
            ASSERT_TRUE(surface.ok());
            uint32_t met = 0;
            for (size_t v = 0; v < surface->size(); v += surface->size() / 20) {
                const glm::vec2 place = placeIn(stage, (*surface)[v]);
                const Result<std::optional<ViewPick>> picked = pickAt(stage, place, kPickAspect);
                ASSERT_TRUE(picked.ok()) << picked.error().message;
                if (!picked->has_value()) {
                    continue; // an edge of the figure
                }
                ++met;
                const ViewPick& pick = **picked;
                EXPECT_LT(glm::distance(placeIn(stage, pick.position), place), 1e-4f);
                const float eye = glm::distance(stage.camera().eye(), pick.position);
                EXPECT_LE(eye, glm::distance(stage.camera().eye(), (*surface)[v]) * 1.01f) << "nothing hides it";
                float sum = 0.0f, before = 1.0f;
                for (const ViewPick::Joint& joint : pick.joints) {
                    sum += joint.weight;
                    EXPECT_LE(joint.weight, before + 1e-6f);
                    before = joint.weight;
                    EXPECT_LT(joint.number, stage.figure().jointNames().size());
                }
                EXPECT_NEAR(sum, 1.0f, 1e-4f);
                EXPECT_LT(pick.part, stage.figure().partNames().size());
            }
            EXPECT_GE(met, 15u);
            const Result<std::optional<ViewPick>> nothing = pickAt(stage, {0.001f, 0.001f}, kPickAspect);
            ASSERT_TRUE(nothing.ok());
            EXPECT_FALSE(nothing->has_value());
        }
        const glm::vec2 middle = placeIn(stage, stage.group().readSurface()->front());
        const Result<std::optional<ViewPick>> before = pickAt(stage, middle, kPickAspect);
        ASSERT_TRUE(before.ok() && before->has_value());
        stage.settings.shownParts[(*before)->part] = false;
        const Result<std::optional<ViewPick>> behind = pickAt(stage, middle, kPickAspect);
        ASSERT_TRUE(behind.ok());
        EXPECT_TRUE(!behind->has_value() || (*behind)->part != (*before)->part);
        stage.settings.shownParts.assign(stage.settings.shownParts.size(), false);
        const Result<std::optional<ViewPick>> nobody = pickAt(stage, middle, kPickAspect);
        ASSERT_TRUE(nobody.ok());
        EXPECT_FALSE(nobody->has_value());
    }
    EXPECT_EQ((*device)->validation()->messageCount(), 0u);
}

} // namespace
} // namespace supple::tools
