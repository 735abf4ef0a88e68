// How timings are read, and that what a host draws in the same command buffer does not change them.
#include "host/draw_target.h"
#include "host/rendering.h"
#include "tests/support/crowd.h"
#include "tests/support/sample_assets.h"
#include "tests/support/wrapped_vulkan.h"

#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <map>

namespace supple::test {
namespace {

std::vector<SuppleTiming> timingsOf(SuppleContext context) {
    uint32_t count = 0;
    if (suppleGetTimings(context, sizeof(SuppleTiming), nullptr, &count) != SUPPLE_OK) {
        return {};
    }
    std::vector<SuppleTiming> timings(count);
    EXPECT_EQ(suppleGetTimings(context, sizeof(SuppleTiming), timings.data(), &count), SUPPLE_OK);
    return timings;
}

/// An older and a newer caller's array: entries lie as far apart as it says.
TEST(Timings, EntriesMayGrow) {
    LoggedContext context(*testDevice());
    ASSERT_EQ(context.result(), SUPPLE_OK);
    SuppleAsset asset{};
    ASSERT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
    const SmallGroup small = createGroup(context.handle(), asset);
    context.evaluate({&small.group, 1}, SUPPLE_RECORD_TIMINGS);
    context.beginFrame();
    const std::vector<SuppleTiming> timings = timingsOf(context.handle());
    ASSERT_GE(timings.size(), 3u);
    struct Newer {
        SuppleTiming known;
        uint64_t more;
    };
    std::vector<Newer> newer(timings.size() + 1);
    std::memset(newer.data(), 0xA5, newer.size() * sizeof(Newer));
    uint32_t count = 2;
    EXPECT_EQ(suppleGetTimings(context.handle(), sizeof(Newer), &newer[0].known, &count), SUPPLE_INCOMPLETE);
    EXPECT_EQ(count, timings.size());
    EXPECT_EQ(newer[2].more, 0xA5A5A5A5A5A5A5A5ull) << "there was room for two";
    EXPECT_EQ(suppleGetTimings(context.handle(), sizeof(Newer), &newer[0].known, &count), SUPPLE_OK);
    for (size_t i = 0; i < timings.size(); ++i) {
        EXPECT_EQ(std::memcmp(&newer[i].known, &timings[i], sizeof(SuppleTiming)), 0) << i;
        EXPECT_EQ(newer[i].more, 0u) << "what this version does not know";
    }
    EXPECT_EQ(newer.back().more, 0xA5A5A5A5A5A5A5A5ull);
}

/// Frames of which two are in flight, on a device that says it is of this type: each frame's timings arrive.
void readsTimings(VkPhysicalDeviceType type, uint64_t& reads, uint64_t& copies) {
    constexpr uint64_t kFrames = 6;
    wrappedVulkan().deviceType = type;
    const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
    ASSERT_NE(device, nullptr);
    {
        LoggedContext context(*device, [](SuppleContextDesc& desc) { desc.mapping = SUPPLE_MAPPING_NARROW; });
        ASSERT_EQ(context.result(), SUPPLE_OK);
        SuppleAsset asset{};
        ASSERT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
        const SmallGroup small = createGroup(context.handle(), asset);
        Commands even(*device), odd(*device);
        for (uint64_t frame = 1; frame <= kFrames; ++frame) {
            Commands& commands = frame % 2 == 0 ? even : odd;
            commands.wait();
            const uint64_t completed = frame > 2 ? frame - 2 : 0;
            ASSERT_EQ(suppleBeginFrame(context.handle(), frame, completed), SUPPLE_OK);
            const std::vector<SuppleTiming> timings = timingsOf(context.handle());
            ASSERT_EQ(timings.empty(), completed == 0);
            for (const SuppleTiming& timing : timings) {
                EXPECT_EQ(timing.frame, completed);
                EXPECT_GE(timing.gpuEnd, timing.gpuBegin);
            }
            EXPECT_TRUE(timings.empty() || timings.back().gpuEnd > timings.front().gpuBegin);
            commands.record([&](VkCommandBuffer buffer) {
                EXPECT_EQ(context.record(buffer, {&small.group, 1}, SUPPLE_RECORD_TIMINGS), SUPPLE_OK);
            });
            commands.submit();
        }
    }
    reads = currentWrappedVulkan().queryReads;
    copies = currentWrappedVulkan().queryCopies;
    EXPECT_EQ(device->validation()->messageCount(), 0u);
}

TEST(Timings, OfCpuDevicesAreCopiedByTheCommandBuffer) {
    uint64_t reads = 0, copies = 0;
    readsTimings(VK_PHYSICAL_DEVICE_TYPE_CPU, reads, copies);
    EXPECT_EQ(reads, 0u) << "lavapipe would wait for the device";
    EXPECT_EQ(copies, 6u);
}

TEST(Timings, OfGpusAreReadFromTheQueries) {
    uint64_t reads = 0, copies = 0;
    readsTimings(VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, reads, copies);
    EXPECT_EQ(reads, 4u);
    EXPECT_EQ(copies, 0u) << "a GPU would stall";
}

/// A render pass that clears: enough to make a CPU device rasterize.
void recordDraws(VkCommandBuffer commands, const host::DrawTarget& target) {
    constexpr VkImageLayout kColor = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                            kDepth = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    const SuppleSyncScope any = kAnyUse;
    host::imageBarrier(commands, target.color(), {VK_IMAGE_LAYOUT_UNDEFINED, any}, {kColor, any});
    host::imageBarrier(commands, target.depth(), {VK_IMAGE_LAYOUT_UNDEFINED, any}, {kDepth, any});
    const VkRenderingAttachmentInfo color = host::attachment(target.color(), kColor);
    host::beginRendering(commands, target.extent(), {&color, 1},
                         host::attachment(target.depth(), kDepth, {.depthStencil = {1.0f, 0}}));
    vkCmdEndRendering(commands);
}

class DrawnTimings : public CrowdContexts {};

TEST_F(DrawnTimings, EveryPassOfEveryGroupHasItsOwnTime) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    Result<host::DrawTarget> target = host::DrawTarget::create(*testDevice(), {1280, 720}, VK_SAMPLE_COUNT_1_BIT);
    ASSERT_TRUE(target.ok());
    SuppleGroupDesc desc{};
    desc.asset = own.asset(kPip);
    desc.capacity = 1;
    desc.rate = 8;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.flags = SUPPLE_GROUP_MOTION;
    Crowd a(own, desc), b(own, desc);
    ASSERT_TRUE(a.valid() && b.valid());
    (void)a.spawn();
    (void)b.spawn();
    const SuppleGroup groups[] = {a.group(), b.group()};

    // The least of some frames: other processes only add. Both groups are alike, and motion does most of what evaluate
    // does. What a pass took, or another group, must not stand with its neighbor: with draws lavapipe once gave
    // evaluate 2.4 ms and motion 0.02.
    std::map<std::pair<std::string, uint64_t>, double> least;
    for (int frame = 0; frame < 6; ++frame) {
        own.beginFrame();
        for (const SuppleTiming& timing : timingsOf(own.handle())) {
            double& entry = least.try_emplace({suppleGetPassName(timing.pass), timing.group.id}, 1e30).first->second;
            entry = std::min(entry, timing.gpuEnd - timing.gpuBegin);
        }
        ASSERT_TRUE(testDevice()
                        ->submitAndWait([&](VkCommandBuffer commands) {
                            EXPECT_EQ(own.LoggedContext::record(commands, groups, SUPPLE_RECORD_TIMINGS), SUPPLE_OK);
                            recordDraws(commands, *target);
                        })
                        .ok());
    }
    if (least.empty()) {
        GTEST_SKIP() << "the queue has no timestamps";
    }
    const double whole = least.at({"evaluate", a.group().id});
    for (const SuppleGroup& group : groups) {
        for (const char* pass : {"evaluate", "motion"}) {
            EXPECT_GT(least.at({pass, group.id}), 0.1 * whole) << pass << " of group " << group.id;
        }
    }
}

} // namespace
} // namespace supple::test
