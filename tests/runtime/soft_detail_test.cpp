// What instances show of what is soft by their size on the screen, and what a group takes for it.
#include "runtime/step_detail.h"
#include "tests/support/soft_groups.h"
#include "tests/support/swinging_jiggles.h"
#include "tests/support/test_view.h"
#include "tests/support/worst.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <optional>

namespace supple::test {
namespace {

class SoftDetail : public CrowdContexts {};

constexpr uint32_t kAllThatSwings = SUPPLE_GROUP_SPRINGS | SUPPLE_GROUP_SOFT;

/// One instance in a view, so many pixels large.
class SizedGroup {
public:
    SizedGroup(CrowdContext& context, SuppleAsset asset, uint32_t flags, uint32_t clip) : view_(context, 1u << 18) {
        SuppleGroupDesc desc = playedGroup(asset, 1, flags);
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.view = view_.handle();
        group_.emplace(context, desc);
        if (valid()) {
            group_->play(0, clip, 0.1);
        }
    }
    [[nodiscard]] bool valid() const { return group_->crowd.valid(); }
    void frame(double time, float pixels) {
        constexpr float kAway = 1000.0f; // so that sizes hardly depend on the pose
        view_.camera.pixelsPerUnit = pixels * kAway / longestSide();
        view_.look({0.0f, 1.0f, kAway});
        group_->frame(time);
    }
    [[nodiscard]] Floats shown() const { return group_->shown(0); }
    [[nodiscard]] float longestSide() const { return group_->longestSide(); }

private:
    TestView view_; // outlives the group
    std::optional<SoftGroup> group_;
};

TEST_F(SoftDetail, OnlySpringsAreLeftBelowASize) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    const SuppleAsset wren = swingingAndJigglingWren(own);
    SizedGroup sized(own, wren, kAllThatSwings, 2), all(own, wren, kAllThatSwings | SUPPLE_GROUP_POSE_UNSEEN, 2),
        springs(own, wren, SUPPLE_GROUP_SPRINGS, 2), none(own, wren, 0, 2);
    ASSERT_TRUE(sized.valid() && all.valid() && springs.valid() && none.valid());
    for (uint32_t step = 0; step < 150; ++step) {
        SCOPED_TRACE(step);
        const float pixels = step < 20 ? 200.0f : step < 40 ? 56.0f : step < 70 ? 36.0f : step < 100 ? 10.0f : 300.0f;
        for (SizedGroup* const group : {&sized, &all, &springs, &none}) {
            group->frame(step / 60.0, pixels);
        }
        if (step < 40) {
            EXPECT_EQ(sized.shown(), all.shown()) << "vertices that jiggle are light already";
        } else if (step > 56 && step < 70) {
            EXPECT_EQ(sized.shown(), springs.shown());
        } else if (step > 86 && step < 100) {
            EXPECT_EQ(sized.shown(), none.shown());
        }
        if (step == 99 || step == 149) {
            EXPECT_GT(farthestApart(all.shown(), none.shown()), 1e-3);
        }
    }
    EXPECT_LT(farthestApart(sized.shown(), all.shown()), 0.03) << "they come together";
}

/// A camera that goes away and comes back: what changes from frame to frame of what simulation does, in pixels.
struct Course {
    std::vector<Floats> shown;
    double mostPixels = 0.0;
};
float pixelsAt(uint32_t step) {
    const float way = static_cast<float>(step < 100 ? step : 200 - step) / 100.0f;
    return 240.0f * (1.0f - way) + 8.0f * way;
}
Course courseOf(SizedGroup& sized, SizedGroup& none) {
    Course course;
    Floats before;
    for (uint32_t step = 0; step < 200; ++step) {
        const float pixels = pixelsAt(step);
        sized.frame(step / 60.0, pixels);
        none.frame(step / 60.0, pixels);
        Floats offsets = sized.shown();
        const Floats stiff = none.shown();
        for (size_t k = 0; k < offsets.size(); ++k) {
            offsets[k] -= stiff[k];
        }
        if (step > 20) { // the cape comes to hang
            const double apart = farthestApart(offsets, before);
            raise(course.mostPixels, apart * static_cast<double>(pixels / sized.longestSide()));
        }
        before = std::move(offsets);
        if (step % 10 == 0) {
            course.shown.push_back(sized.shown());
        }
    }
    return course;
}

TEST_F(SoftDetail, NothingJumpsWhereDetailChangesAndBothMappingsHaveTheSameBits) {
    const ValidationGuard guard;
    std::vector<Floats> first;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        const SuppleAsset caped = own.asset(kCapedFile);
        SizedGroup sized(own, caped, SUPPLE_GROUP_SOFT, 0), none(own, caped, 0, 0),
            all(own, caped, SUPPLE_GROUP_SOFT | SUPPLE_GROUP_POSE_UNSEEN, 0);
        ASSERT_TRUE(sized.valid() && all.valid() && none.valid());
        const Course changes = courseOf(sized, none), always = courseOf(all, none);
        EXPECT_LT(changes.mostPixels, always.mostPixels + 0.5);
        RecordProperty("MostPixels", std::to_string(changes.mostPixels) + " " + std::to_string(always.mostPixels));
        EXPECT_NE(changes.shown, always.shown);
        first = first.empty() ? changes.shown : first;
        EXPECT_EQ(changes.shown, first);
    }
}

/// Device memory of an instance, by two capacities.
double bytesOfInstance(CrowdContext& own, SuppleAsset asset, uint32_t flags) {
    std::array<double, 2> bytes{};
    for (size_t k = 0; k < 2; ++k) {
        SoftGroup group(own, playedGroup(asset, k == 0 ? 64 : 192, flags));
        const gpu::MemoryUse use = group.group().memoryUse();
        bytes[k] = static_cast<double>(use.total() - use.hostVisible());
    }
    return (bytes[1] - bytes[0]) / 128.0;
}

/// docs/soft.md, "Memory".
TEST_F(SoftDetail, MemoryOfAnInstanceIsWhatTheDocsCount) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = own.asset(kCapedFile);
    SoftGroup group(own, playedGroup(asset, 1, kSoft));
    const runtime::Asset& soft = group.group().asset();
    const uint32_t state = soft.jiggles.stateElements + soft.cloths.stateElements;
    const auto nodes = static_cast<uint32_t>(soft.clipTable->nodes.size());
    const skinning::PoseLayout& layout = group.group().instances().poseLayout();
    const double work = 16.0 * (3.0 * (nodes + 2.0) + layout.elements()), list = 4.0 * 243.0;
    const double played = 16.0 * skinning::PlaybackState::elements(layout.morphCount, 0);
    const double more = bytesOfInstance(own, asset, kSoft) - bytesOfInstance(own, asset, 0);
    const double counted = 16.0 * state + work + played + list;
    EXPECT_GE(more, counted);
    EXPECT_LE(more, counted + 6 * 256.0) << "each buffer is aligned";
}

} // namespace
} // namespace supple::test
