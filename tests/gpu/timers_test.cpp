// Timestamps: runs never overlap, whoever takes them, and a pool that is used up says so.
#include "gpu/timers.h"
#include "tests/gpu/fake_vulkan.h"

#include <atomic>
#include <gtest/gtest.h>
#include <set>
#include <thread>
#include <vector>

namespace supple::gpu {
namespace {

TEST(Timers, AreTakenUntilNoneAreLeft) {
    test::FakeVulkan vulkan;
    Result<Timers> timers = Timers::create(vulkan.device, 10, "frame 0");
    ASSERT_TRUE(timers.ok());
    uint32_t first = 99;
    EXPECT_TRUE(timers->take(test::kCommands, 6, first));
    EXPECT_EQ(first, 0u);
    EXPECT_FALSE(timers->take(test::kCommands, 5, first)) << "four are left";
    EXPECT_TRUE(timers->take(test::kCommands, 4, first));
    EXPECT_EQ(first, 6u);
    EXPECT_FALSE(timers->take(test::kCommands, 1, first));
    EXPECT_EQ(vulkan.resets, (std::vector<std::pair<uint32_t, uint32_t>>{{0, 6}, {6, 4}}));
    timers->clear();
    EXPECT_TRUE(timers->take(test::kCommands, 10, first));
    EXPECT_EQ(first, 0u);
}

TEST(Timers, AreTakenByManyThreads) {
    constexpr uint32_t kThreads = 4;
    constexpr uint32_t kRuns = 200;
    constexpr uint32_t kLength = 3;
    test::FakeVulkan vulkan;
    Result<Timers> timers = Timers::create(vulkan.device, kThreads * kRuns * kLength, "frame 0");
    ASSERT_TRUE(timers.ok());
    std::atomic<uint32_t> refused = 0;
    std::vector<std::thread> threads;
    for (uint32_t t = 0; t < kThreads; ++t) {
        threads.emplace_back([&] {
            for (uint32_t i = 0; i < kRuns; ++i) {
                uint32_t first = 0;
                refused += timers->take(test::kCommands, kLength, first) ? 0 : 1;
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    EXPECT_EQ(refused, 0u);
    std::set<uint32_t> firsts;
    for (const auto& [first, count] : vulkan.resets) {
        EXPECT_EQ(first % kLength, 0u);
        EXPECT_EQ(count, kLength);
        firsts.insert(first);
    }
    EXPECT_EQ(firsts.size(), size_t{kThreads} * kRuns) << "two took the same run";
}

TEST(Timers, TellWhatTheDeviceHasNotWritten) {
    test::FakeVulkan vulkan;
    vulkan.queryResults = {100, 1, 0, 0};
    Result<Timers> timers = Timers::create(vulkan.device, 8, "frame 0");
    ASSERT_TRUE(timers.ok());
    const Result<std::span<const Timers::Tick>> none = timers->read();
    ASSERT_TRUE(none.ok());
    EXPECT_TRUE(none->empty()) << "none were taken";
    uint32_t first = 0;
    ASSERT_TRUE(timers->take(test::kCommands, 2, first));
    const Result<std::span<const Timers::Tick>> ticks = timers->read();
    ASSERT_TRUE(ticks.ok());
    ASSERT_EQ(ticks->size(), 2u);
    EXPECT_EQ((*ticks)[0].value, 100u);
    EXPECT_NE((*ticks)[0].available, 0u);
    EXPECT_EQ((*ticks)[1].available, 0u);
}

TEST(Timers, OfLazyTimestampsAreCopiedByTheCommandBuffer) {
    test::FakeVulkan vulkan;
    vulkan.device.mapping.lazyTimestamps = true;
    vulkan.device.vk.GetQueryPoolResults = nullptr;
    vulkan.queryResults = {100, 1, 200, 1, 300, 1, 400, 1};
    Result<Timers> timers = Timers::create(vulkan.device, 4, "frame 0");
    ASSERT_TRUE(timers.ok());
    uint32_t first = 0;
    ASSERT_TRUE(timers->take(test::kCommands, 1, first));
    ASSERT_TRUE(timers->take(test::kCommands, 3, first));
    timers->mark(test::kCommands, first);
    ASSERT_EQ(vulkan.barriers.size(), 1u) << "what comes behind a mark waits for it";
    timers->mark(test::kCommands, first + 1);
    timers->finish(test::kCommands, first, 2);
    ASSERT_EQ(vulkan.barriers.size(), 3u);
    EXPECT_EQ(vulkan.barriers[2].after, VkPipelineStageFlags{VK_PIPELINE_STAGE_HOST_BIT});
    const auto available = [&] {
        std::vector<uint64_t> values;
        const Result<std::span<const Timers::Tick>> ticks = timers->read();
        EXPECT_TRUE(ticks.ok());
        for (const Timers::Tick& tick : *ticks) {
            values.push_back(tick.available != 0 ? tick.value : 0);
        }
        return values;
    };
    EXPECT_EQ(available(), (std::vector<uint64_t>{0, 200, 300, 0})) << "those that were finished";
    timers->clear();
    ASSERT_TRUE(timers->take(test::kCommands, 4, first));
    EXPECT_EQ(available(), (std::vector<uint64_t>{0, 0, 0, 0})) << "none of the frame before";
}

} // namespace
} // namespace supple::gpu
