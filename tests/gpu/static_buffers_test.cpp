// Static buffers: uploaded once, again where the frame never ran, and without staging memory once it has.
#include "gpu/static_buffers.h"
#include "gpu/uploads.h"
#include "tests/gpu/fake_vulkan.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <vector>

namespace supple::gpu {
namespace {

constexpr std::array kPositions{std::byte{1}, std::byte{2}, std::byte{3}};
constexpr std::array kFaces{std::byte{4}, std::byte{5}};

Result<StaticBuffers> makeBuffers(const Device& device) {
    const std::vector<StaticRequest> requests{{"positions", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, kPositions},
                                              {"nothing", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, {}},
                                              {"faces", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, kFaces}};
    return StaticBuffers::create(device, requests);
}

TEST(StaticBuffers, AreUploadedOnce) {
    test::FakeVulkan vulkan;
    Result<StaticBuffers> buffers = makeBuffers(vulkan.device);
    ASSERT_TRUE(buffers.ok()) << buffers.error().message;
    EXPECT_TRUE(buffers->staticsPending());
    EXPECT_EQ(buffers->recordStatics(test::kCommands, 1), kPositions.size() + kFaces.size());
    EXPECT_FALSE(buffers->staticsPending());
    EXPECT_EQ(buffers->recordStatics(test::kCommands, 2), 0u);
    EXPECT_EQ(vulkan.copies.size(), 2u);

    const test::FakeVulkan::BoundBuffer& faces = vulkan.buffers.at(buffers->buffer(2));
    const auto first = vulkan.memory.at(faces.memory).begin() + static_cast<ptrdiff_t>(faces.offset);
    EXPECT_TRUE(std::equal(kFaces.begin(), kFaces.end(), first));
}

TEST(StaticBuffers, AreUploadedAgainWhereTheFrameNeverRan) {
    test::FakeVulkan vulkan;
    Result<StaticBuffers> buffers = makeBuffers(vulkan.device);
    ASSERT_TRUE(buffers.ok()) << buffers.error().message;
    ASSERT_GT(buffers->recordStatics(test::kCommands, 4), 0u);
    buffers->cancelFrame(3);
    EXPECT_FALSE(buffers->staticsPending()) << "another frame's";
    buffers->cancelFrame(4);
    EXPECT_TRUE(buffers->staticsPending());
    EXPECT_GT(buffers->recordStatics(test::kCommands, 5), 0u);
}

TEST(StaticBuffers, FreeTheirStagingMemoryWhenTheFrameIsComplete) {
    test::FakeVulkan vulkan;
    Result<StaticBuffers> buffers = makeBuffers(vulkan.device);
    ASSERT_TRUE(buffers.ok()) << buffers.error().message;
    EXPECT_EQ(vulkan.memory.size(), 2u);
    buffers->beginFrame(9);
    EXPECT_EQ(vulkan.memory.size(), 2u) << "nothing is uploaded yet";
    ASSERT_GT(buffers->recordStatics(test::kCommands, 10), 0u);
    buffers->beginFrame(9);
    EXPECT_EQ(vulkan.memory.size(), 2u) << "the frame may still run";
    buffers->beginFrame(10);
    EXPECT_EQ(vulkan.memory.size(), 1u);
    buffers->cancelFrame(10);
    EXPECT_FALSE(buffers->staticsPending()) << "a complete frame is not cancelled";
}

/// With a budget of two bytes a frame.
class UploadBudget : public testing::Test {
protected:
    void SetUp() override {
        vulkan.device.uploads = &uploads;
        ASSERT_TRUE(uploads.setBudget(vulkan.device, 2, 2).ok());
        Result<StaticBuffers> made = makeBuffers(vulkan.device);
        ASSERT_TRUE(made.ok()) << made.error().message;
        buffers = std::move(*made);
    }
    VkDeviceSize record(uint64_t frame, uint64_t completed) {
        uploads.beginFrame(frame, completed);
        buffers.beginFrame(completed);
        return buffers.recordStatics(test::kCommands, frame);
    }
    [[nodiscard]] StaticCount count(uint64_t frame) {
        StaticCount result;
        result.number = ++counts;
        result.frame = frame;
        buffers.countStatics(result);
        buffers.countStatics(result);
        return result;
    }

    test::FakeVulkan vulkan;
    Uploads uploads;
    StaticBuffers buffers;
    uint64_t counts = 0;
};

TEST_F(UploadBudget, CutsWhatGoesUpIntoFrames) {
    EXPECT_EQ(vulkan.memory.size(), 2u) << "the buffers and the budget: no staging memory of their own";
    EXPECT_EQ(record(1, 0), 2u);
    EXPECT_TRUE(buffers.staticsPending());
    EXPECT_EQ(buffers.recordStatics(test::kCommands, 1), 0u) << "the frame has no more";
    EXPECT_EQ(uploads.frameBytes(), 2u);
    EXPECT_EQ(count(1).bytes, 5u);
    EXPECT_EQ(count(1).left, 3u);
    EXPECT_EQ(count(1).frameBytes, 2u);
    EXPECT_EQ(record(2, 0), 2u) << "the end of one buffer and the beginning of another";
    EXPECT_EQ(vulkan.copies.size(), 3u);
    EXPECT_EQ(count(3).frameBytes, 0u);
    EXPECT_EQ(record(3, 1), 1u);
    EXPECT_FALSE(buffers.staticsPending());
    EXPECT_EQ(uploads.totalBytes(), 5u);
}

TEST_F(UploadBudget, GoesBackByWhatACancelledFrameHad) {
    EXPECT_EQ(record(1, 0), 2u);
    EXPECT_EQ(record(2, 0), 2u);
    buffers.cancelFrame(2);
    uploads.cancelFrame();
    EXPECT_EQ(uploads.totalBytes(), 2u);
    EXPECT_EQ(count(2).left, 3u);
    EXPECT_EQ(count(2).frameBytes, 0u);
    EXPECT_EQ(record(3, 2), 2u);
    EXPECT_EQ(record(4, 3), 1u);
    buffers.cancelFrame(3);
    EXPECT_FALSE(buffers.staticsPending()) << "another frame's";
    EXPECT_EQ(uploads.totalBytes(), 5u);
}

TEST_F(UploadBudget, PutsBytesIntoTheFramesPartOfTheMemory) {
    const auto staged = [&](size_t at) {
        for (const auto& [memory, bytes] : vulkan.memory) {
            if (bytes.size() < 128) { // the budget's
                return bytes[at];
            }
        }
        return std::byte{0};
    };
    const size_t sizes = vulkan.memory.size();
    EXPECT_EQ(record(1, 0), 2u);
    EXPECT_EQ(record(2, 0), 2u);
    EXPECT_EQ(vulkan.memory.size(), sizes);
    EXPECT_EQ(staged(2), kPositions[0]); // frame 1
    EXPECT_EQ(staged(3), kPositions[1]);
    EXPECT_EQ(staged(0), kPositions[2]); // frame 2
    EXPECT_EQ(staged(1), kFaces[0]);
}

TEST_F(UploadBudget, MayChangeAndEndInBetween) {
    EXPECT_EQ(record(1, 0), 2u);
    ASSERT_TRUE(uploads.setBudget(vulkan.device, 3, 2).ok());
    EXPECT_EQ(vulkan.memory.size(), 3u) << "frame 1 may still read the memory before";
    EXPECT_EQ(buffers.recordStatics(test::kCommands, 1), 1u) << "what the frame has left of the new budget";
    ASSERT_TRUE(buffers.stageStatics().ok());
    ASSERT_TRUE(uploads.setBudget(vulkan.device, 0, 2).ok());
    EXPECT_EQ(record(2, 1), 2u);
    EXPECT_FALSE(buffers.staticsPending());
    buffers.beginFrame(2);
    uploads.beginFrame(3, 2);
    EXPECT_EQ(vulkan.memory.size(), 1u);
}

TEST_F(UploadBudget, KeepsBytesUntilTheyAreUploaded) {
    auto bytes = std::make_shared<const std::vector<std::byte>>(3, std::byte{7});
    const std::weak_ptr<const std::vector<std::byte>> kept = bytes;
    StaticRequest request{"kept", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, *bytes, bytes};
    Result<StaticBuffers> made = StaticBuffers::create(vulkan.device, {&request, 1});
    ASSERT_TRUE(made.ok());
    request.keeper.reset();
    bytes.reset();
    buffers = std::move(*made);
    EXPECT_EQ(record(1, 0), 2u);
    EXPECT_EQ(record(2, 1), 1u);
    buffers.beginFrame(1);
    EXPECT_FALSE(kept.expired()) << "the frame may be cancelled";
    buffers.beginFrame(2);
    EXPECT_TRUE(kept.expired());
}

TEST(Uploads, RefuseABudgetThatNoMemoryHas) {
    test::FakeVulkan vulkan;
    Uploads uploads;
    ASSERT_TRUE(uploads.setBudget(vulkan.device, 16, 2).ok());
    EXPECT_FALSE(uploads.setBudget(vulkan.device, UINT64_MAX / 2, 3).ok());
    EXPECT_EQ(uploads.setBudget(vulkan.device, VkDeviceSize{1} << 40, 2).error().code, ErrorCode::limit);
    EXPECT_EQ(uploads.budget(), 16u);
}

} // namespace
} // namespace supple::gpu
