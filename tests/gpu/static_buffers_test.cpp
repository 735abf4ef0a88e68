// Static buffers: uploaded once, again where the frame never ran, and without staging memory once it has.
#include "gpu/static_buffers.h"
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

} // namespace
} // namespace supple::gpu
