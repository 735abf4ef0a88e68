// Handles destroy what they own once, wherever it has been moved.
#include "gpu/handle.h"
#include "tests/gpu/fake_vulkan.h"

#include <gtest/gtest.h>
#include <utility>

namespace supple::gpu {
namespace {

BufferHandle makeBuffer(const Device& device) {
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = 4;
    VkBuffer buffer = VK_NULL_HANDLE;
    EXPECT_EQ(device.vk.CreateBuffer(device.handle, &info, device.allocator, &buffer), VK_SUCCESS);
    return BufferHandle(device, buffer);
}

TEST(Handle, DestroysWhatItOwns) {
    test::FakeVulkan vulkan;
    {
        const BufferHandle buffer = makeBuffer(vulkan.device);
        EXPECT_EQ(vulkan.buffers.count(buffer.get()), 1u);
    }
    EXPECT_TRUE(vulkan.buffers.empty());
}

TEST(Handle, MovesWhatItOwns) {
    test::FakeVulkan vulkan;
    {
        BufferHandle a = makeBuffer(vulkan.device);
        const VkBuffer buffer = a.get();
        const BufferHandle b = std::move(a);
        EXPECT_EQ(b.get(), buffer);
        EXPECT_EQ(vulkan.buffers.size(), 1u);
    }
    EXPECT_TRUE(vulkan.buffers.empty());
}

TEST(Handle, AssignmentKeepsBothAlive) {
    test::FakeVulkan vulkan;
    BufferHandle a = makeBuffer(vulkan.device);
    {
        BufferHandle b = makeBuffer(vulkan.device);
        const VkBuffer buffer = b.get();
        a = std::move(b); // b destroys what a had
        EXPECT_EQ(a.get(), buffer);
        EXPECT_EQ(vulkan.buffers.size(), 2u);
    }
    EXPECT_EQ(vulkan.buffers.size(), 1u);
    EXPECT_EQ(vulkan.buffers.count(a.get()), 1u);
    a = BufferHandle();
    EXPECT_TRUE(vulkan.buffers.empty());
}

} // namespace
} // namespace supple::gpu
