// Tasks of shared dispatches (gpu/tasks.h) in their room: what is kept of them, and what is written over it.
#include "gpu/task_rewriter.h"
#include "tests/gpu/fake_vulkan.h"

#include <gtest/gtest.h>
#include <memory>
#include <vector>

namespace supple::gpu {
namespace {

constexpr uint64_t kTooMany = 0xFFFF0000u; ///< workgroups for two tasks of a dispatch

/// Groups of no workgroups, so that nothing is bound.
class KeptTasksRoom : public testing::Test {
protected:
    void make(const TaskNeeds& needs) {
        needs_ = {needs.tasks + TaskDispatches::kPhases, needs.buffers};
        Result<std::unique_ptr<TaskRoom>> made =
            TaskRoom::create(vulkan.device, {2 * needs_.tasks, 2 * needs_.buffers}, 1);
        ASSERT_TRUE(made.ok()) << made.error().message;
        room = std::move(*made);
    }
    void dispatch(Dispatches& dispatches, uint32_t push, uint64_t groups = 0) {
        dispatches.dispatch(kernel, {VK_NULL_HANDLE, &buffers}, push, groups);
    }
    /// A whole recording of one owner, in place 3.
    template <class Record>
    void record(Record&& record) {
        TaskDispatches tasks(vulkan.device, test::kCommands, *room, counts, needs_);
        tasks.begin(true);
        tasks.addOwner({.id = 1});
        tasks.setOwner(0);
        tasks.enter(3);
        record(tasks);
        tasks.flush();
        tasks.leave();
        tasks.end();
    }
    static std::vector<uint64_t> groupsOf(const KeptTasks::Owner& owner) {
        std::vector<uint64_t> groups;
        for (const RecordedTask* task = owner.first; task != nullptr; task = task->nextOfOwner) {
            groups.push_back(task->groups);
        }
        return groups;
    }

    test::FakeVulkan vulkan;
    Kernel kernel, counts;
    TaskBuffers buffers;
    TaskNeeds needs_;
    std::unique_ptr<TaskRoom> room;
};

TEST_F(KeptTasksRoom, KnowsTheirPlaces) {
    make({2, 1});
    record([&](TaskDispatches& tasks) { dispatch(tasks, 1); });
    room->clear();
    TaskDispatches later(vulkan.device, test::kCommands, *room, counts, needs_);
    KeptTasks* const kept = later.kept();
    ASSERT_NE(kept, nullptr);
    for (uint32_t place = 0; place < 2 * KeptTasks::kPlaces; ++place) {
        EXPECT_EQ(kept->uses(place), place == 3) << place;
    }
}

TEST_F(KeptTasksRoom, TasksStayBehindTheBarrierTheyWaitFor) {
    make({3, 1});
    record([&](TaskDispatches& tasks) {
        dispatch(tasks, 1);
        tasks.computeBarrier();
        dispatch(tasks, 2);
        dispatch(tasks, 3);
    });
    room->clear();
    TaskDispatches later(vulkan.device, test::kCommands, *room, counts, needs_);
    KeptTasks* const kept = later.kept();
    ASSERT_NE(kept, nullptr);
    const auto rewrite = [&](bool first) {
        TaskRewriter rewriter(later, kept->owners()[0], 0);
        rewriter.enter(3);
        if (first) {
            dispatch(rewriter, 4, 10);
        }
        rewriter.computeBarrier();
        dispatch(rewriter, 5, 20);
        return rewriter.end(KeptTasks::kPlaces - 1);
    };
    EXPECT_TRUE(rewrite(false));
    EXPECT_EQ(groupsOf(kept->owners()[0]), (std::vector<uint64_t>{0, 20, 0}));
    EXPECT_TRUE(rewrite(true));
    EXPECT_EQ(groupsOf(kept->owners()[0]), (std::vector<uint64_t>{10, 20, 0}));
    // What waits for a task that is not there has no place.
    TaskRewriter rewriter(later, kept->owners()[0], 0);
    rewriter.enter(3);
    dispatch(rewriter, 4, 10);
    rewriter.computeBarrier();
    dispatch(rewriter, 5, 20);
    rewriter.computeBarrier();
    dispatch(rewriter, 6, 30);
    EXPECT_FALSE(rewriter.end(KeptTasks::kPlaces - 1));
}

TEST_F(KeptTasksRoom, CopyNothingIfTooManyWorkgroupsCome) {
    constexpr uint32_t kDispatches = 200;
    make({kDispatches + 1, 1});
    record([&](TaskDispatches& tasks) {
        for (uint32_t i = 0; i < kDispatches; ++i) {
            dispatch(tasks, i);
            tasks.flush();
        }
        dispatch(tasks, kDispatches);
        dispatch(tasks, kDispatches);
    });
    const size_t copies = vulkan.copies.size();
    room->clear();
    for (const uint64_t last : {kTooMany, uint64_t{1}}) {
        TaskDispatches later(vulkan.device, test::kCommands, *room, counts, needs_);
        KeptTasks* const kept = later.kept();
        ASSERT_NE(kept, nullptr);
        TaskRewriter rewriter(later, kept->owners()[0], 0);
        rewriter.enter(3);
        for (uint32_t i = 0; i < kDispatches; ++i) {
            dispatch(rewriter, i, 1);
        }
        dispatch(rewriter, kDispatches, last);
        dispatch(rewriter, kDispatches, last);
        ASSERT_TRUE(rewriter.end(KeptTasks::kPlaces - 1));
        EXPECT_EQ(later.resume(), last == 1);
        EXPECT_EQ(vulkan.copies.size() > copies, last == 1);
        room->clear();
    }
}

TEST_F(KeptTasksRoom, ASecondRecordingKeepsNothingAndCopiesItsOwn) {
    make({1, 1});
    record([&](TaskDispatches& tasks) { dispatch(tasks, 1); });
    record([&](TaskDispatches& tasks) { dispatch(tasks, 2); });
    ASSERT_EQ(vulkan.copiedRegions.size(), 2u);
    std::vector<VkBufferCopy> regions = vulkan.copiedRegions[0];
    const size_t ofFirst = regions.size();
    regions.insert(regions.end(), vulkan.copiedRegions[1].begin(), vulkan.copiedRegions[1].end());
    for (size_t i = 0; i < ofFirst; ++i) {
        for (size_t j = ofFirst; j < regions.size(); ++j) {
            const VkBufferCopy &a = regions[i], &b = regions[j];
            EXPECT_TRUE(a.dstOffset + a.size <= b.dstOffset || b.dstOffset + b.size <= a.dstOffset)
                << "both write at " << b.dstOffset << ", with no barrier between them";
        }
    }
    room->clear();
    TaskDispatches first(vulkan.device, test::kCommands, *room, counts, needs_);
    TaskDispatches second(vulkan.device, test::kCommands, *room, counts, needs_);
    EXPECT_NE(first.kept(), nullptr);
    EXPECT_EQ(second.kept(), nullptr);
}

} // namespace
} // namespace supple::gpu
