#include "gpu/pipelines.h"
#include "shaders/shared/specialization.h"
#include "tests/gpu/fake_vulkan.h"

#include <atomic>
#include <gtest/gtest.h>
#include <mutex>
#include <thread>

namespace supple::gpu {
namespace {

class PipelineCache : public testing::Test {
protected:
    void SetUp() override {
        Result<ComputeLayout> made = ComputeLayout::create(vulkan.device, {}, 16, "layout");
        ASSERT_TRUE(made.ok());
        layout = std::move(*made);
    }
    Kernel ask(Pipelines::Batch& batch, uint32_t rate) const {
        const Constant constant{shared::kRateConstant, rate};
        return batch.get(layout, {words, words}, {&constant, 1}, ("rate " + std::to_string(rate)).c_str());
    }

    test::FakeVulkan vulkan;
    ComputeLayout layout;
    const std::vector<uint32_t> words{1, 2};
};

/// Backwards, to be told from one after the other.
void backwards(uint32_t count, const std::function<void(uint32_t)>& job) {
    while (count > 0) {
        job(--count);
    }
}

TEST_F(PipelineCache, MakesABatchByTheHostsJobs) {
    Pipelines pipelines(vulkan.device, backwards);
    Pipelines::Batch batch(pipelines);
    const Kernel first = ask(batch, 1), second = ask(batch, 2), again = ask(batch, 1);
    EXPECT_EQ(first.pipeline, again.pipeline);
    EXPECT_EQ(vulkan.pipelines.size(), 0u);
    ASSERT_TRUE(batch.make().ok());
    ASSERT_EQ(vulkan.pipelines.size(), 2u);
    EXPECT_EQ(vulkan.pipelines.front().constants.back().second, 2u);
    EXPECT_NE(first.pipeline->get(), second.pipeline->get());
    // It is found again, in a batch or alone.
    Pipelines::Batch later(pipelines);
    EXPECT_EQ(ask(later, 2).pipeline, second.pipeline);
    EXPECT_TRUE(later.make().ok());
    const Constant rate{shared::kRateConstant, 1};
    const Result<Kernel> alone = pipelines.get(layout, {words, words}, {&rate, 1}, "alone");
    ASSERT_TRUE(alone.ok());
    EXPECT_EQ(alone->pipeline, first.pipeline);
    EXPECT_EQ(vulkan.pipelines.size(), 2u);
}

TEST_F(PipelineCache, WhatCannotBeMadeIsTriedAgainByTheNextBatch) {
    for (const bool jobs : {false, true}) {
        SCOPED_TRACE(jobs);
        Pipelines pipelines(vulkan.device, jobs ? RunJobs(backwards) : RunJobs());
        vulkan.pipelines.clear();
        vulkan.pipelineCalls = 0;
        vulkan.failPipeline = 1;
        {
            Pipelines::Batch batch(pipelines);
            for (const uint32_t rate : {1u, 2u, 3u}) {
                (void)ask(batch, rate);
            }
            const Status made = batch.make();
            ASSERT_FALSE(made.ok());
            EXPECT_NE(made.error().message.find("pipeline rate 2"), std::string::npos) << made.error().message;
            EXPECT_EQ(made.error().code, ErrorCode::deviceMemory);
        }
        Pipelines::Batch batch(pipelines);
        const Kernel second = ask(batch, 2);
        ASSERT_TRUE(batch.make().ok());
        EXPECT_NE(second.pipeline->get(), VkPipeline{VK_NULL_HANDLE});
        // What could be made was kept. One after the other, none was tried behind the one that failed.
        EXPECT_EQ(vulkan.pipelines.size(), jobs ? 3u : 2u);
    }
}

TEST_F(PipelineCache, ABatchThatIsNotMadeLeavesNothing) {
    Pipelines pipelines(vulkan.device);
    { // as where something else fails before
        Pipelines::Batch batch(pipelines);
        (void)ask(batch, 1);
    }
    Pipelines::Batch batch(pipelines);
    const Kernel kernel = ask(batch, 1);
    ASSERT_TRUE(batch.make().ok());
    EXPECT_NE(kernel.pipeline->get(), VkPipeline{VK_NULL_HANDLE});
}

TEST_F(PipelineCache, NamesAJobThatTheHostHasNotRun) {
    Pipelines pipelines(vulkan.device, [](uint32_t count, const std::function<void(uint32_t)>& job) {
        for (uint32_t i = 0; i + 1 < count; ++i) {
            job(i);
        }
    });
    Pipelines::Batch batch(pipelines);
    for (const uint32_t rate : {1u, 2u, 3u}) {
        (void)ask(batch, rate);
    }
    const Status made = batch.make();
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().message, "pipeline rate 3: runJobs has not run its job");
    EXPECT_EQ(made.error().code, ErrorCode::argument);
}

/// Jobs that wait until they are told to go on.
struct Held {
    void operator()(uint32_t count, const std::function<void(uint32_t)>& job) {
        begun = true;
        begun.notify_all();
        mayEnd.wait(false);
        for (uint32_t i = 0; i < count; ++i) {
            job(i);
        }
    }
    std::atomic<bool> begun{false}, mayEnd{false};
};

TEST_F(PipelineCache, ThreadsWaitForEachOthersPipelinesAndNoneIsMadeTwice) {
    Held held;
    Pipelines pipelines(vulkan.device, std::ref(held));
    std::thread first([&] {
        Pipelines::Batch batch(pipelines);
        (void)ask(batch, 1);
        EXPECT_TRUE(batch.make().ok());
    });
    held.begun.wait(false);
    Pipelines::Batch batch(pipelines);
    const Kernel kernel = ask(batch, 1); // does not wait
    EXPECT_EQ(ask(batch, 1).pipeline, kernel.pipeline);
    held.mayEnd = true;
    held.mayEnd.notify_all();
    ASSERT_TRUE(batch.make().ok());
    EXPECT_NE(kernel.pipeline->get(), VkPipeline{VK_NULL_HANDLE});
    first.join();
    EXPECT_EQ(vulkan.pipelines.size(), 1u);
}

TEST_F(PipelineCache, WhatAnotherThreadCouldNotMakeIsMade) {
    Held held;
    vulkan.failPipeline = 0;
    Pipelines pipelines(vulkan.device, std::ref(held));
    std::thread first([&] {
        Pipelines::Batch batch(pipelines);
        (void)ask(batch, 1);
        EXPECT_FALSE(batch.make().ok());
    });
    held.begun.wait(false);
    Pipelines::Batch batch(pipelines);
    const Kernel kernel = ask(batch, 1);
    held.mayEnd = true;
    held.mayEnd.notify_all();
    ASSERT_TRUE(batch.make().ok());
    EXPECT_NE(kernel.pipeline->get(), VkPipeline{VK_NULL_HANDLE});
    first.join();
    EXPECT_EQ(vulkan.pipelines.size(), 1u);
}

TEST_F(PipelineCache, ThreadsThatWantTheSameInOtherOrdersGetIt) {
    std::mutex mutex; // the fake takes no notes of two threads at a time
    Pipelines pipelines(vulkan.device, [&](uint32_t count, const std::function<void(uint32_t)>& job) {
        const std::scoped_lock lock(mutex);
        for (uint32_t i = 0; i < count; ++i) {
            job(i);
        }
    });
    std::vector<std::thread> threads;
    for (uint32_t t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (uint32_t round = 0; round < 8; ++round) {
                Pipelines::Batch batch(pipelines);
                std::vector<Kernel> kernels;
                for (uint32_t i = 0; i < 6; ++i) {
                    kernels.push_back(ask(batch, 6 * round + (t % 2 == 0 ? i : 5 - i)));
                }
                if ((round + t) % 3 == 0) {
                    continue; // gives up
                }
                ASSERT_TRUE(batch.make().ok());
                for (const Kernel& kernel : kernels) {
                    EXPECT_NE(kernel.pipeline->get(), VkPipeline{VK_NULL_HANDLE});
                }
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    EXPECT_EQ(vulkan.pipelines.size(), 48u);
}

} // namespace
} // namespace supple::gpu
