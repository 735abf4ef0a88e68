// Which look the viewer's frames have, as time goes by.
#include "tools/supple/view_look.h"

#include <gtest/gtest.h>

namespace supple::tools {
namespace {

using Kind = LookStep::Kind;
constexpr double kAnyTime = 0.03;

TEST(ViewLookTest, ACpuDeviceIsFastWhileSomethingMovesThenRefinesThenRests) {
    LookPace pace(true, 3, true);
    EXPECT_EQ(pace.next(Look::automatic, false, kAnyTime).kind, Kind::fast);
    uint32_t calm = 0;
    LookStep step;
    while ((step = pace.next(Look::automatic, true, kAnyTime)).kind == Kind::fast)
        ASSERT_LT(++calm, 20u);
    EXPECT_GE(calm, 2u) << "a hand that drags rests between two moves";
    for (uint32_t pass = 0; pass < 3; ++pass) {
        EXPECT_EQ(step.kind, Kind::refine);
        EXPECT_EQ(step.pass, pass);
        step = pace.next(Look::automatic, true, kAnyTime);
    }
    for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(step.kind, Kind::keep);
        step = pace.next(Look::automatic, true, kAnyTime);
    }
    EXPECT_EQ(pace.next(Look::automatic, false, kAnyTime).kind, Kind::fast) << "it moves again";
}

TEST(ViewLookTest, OtherDevicesAndTheStudioDrawAllAtOnce) {
    LookPace gpu(false, 3, false);
    LookPace cpu(true, 3, false);
    for (int i = 0; i < 20; ++i) {
        EXPECT_EQ(gpu.next(Look::automatic, true, kAnyTime).kind, Kind::studio);
        EXPECT_EQ(cpu.next(Look::studio, true, kAnyTime).kind, Kind::studio);
    }
    EXPECT_EQ(gpu.next(Look::fast, true, kAnyTime).kind, Kind::fast);
    for (int i = 0; i < 20; ++i)
        EXPECT_EQ(cpu.next(Look::fast, true, kAnyTime).kind, Kind::fast) << "asked for, it stays fast";
}

uint32_t scaleAfter(LookPace& pace, double seconds) {
    uint32_t scale = 0;
    for (int i = 0; i < 40; ++i)
        scale = pace.next(Look::automatic, false, seconds).scaleIndex;
    return scale;
}

TEST(ViewLookTest, PixelsFollowTheTime) {
    LookPace pace(true, 3, false);
    EXPECT_EQ(kFastScales[scaleAfter(pace, 0.004)], 1.0f);
    EXPECT_EQ(kFastScales[scaleAfter(pace, 0.040)], 1.0f) << "between the limits nothing changes";
    EXPECT_EQ(kFastScales[scaleAfter(pace, 0.300)], 0.5f);
    LookPace fixed(true, 3, true);
    EXPECT_EQ(scaleAfter(fixed, 0.004), scaleAfter(fixed, 0.300)) << "counted frames depend on no clock";
}

} // namespace
} // namespace supple::tools
