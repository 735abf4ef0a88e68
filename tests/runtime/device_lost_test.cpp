// Devices that are lost.
#include "tests/support/gpu_surface.h"
#include "tests/support/logged_context.h"
#include "tests/support/wrapped_vulkan.h"

#include <gtest/gtest.h>

namespace supple::test {
namespace {

/// The call gave the one result, with the one line about it.
void expectLost(LoggedContext& context, SuppleResult result, const char* call) {
    EXPECT_EQ(result, SUPPLE_ERROR_DEVICE_LOST) << call;
    const std::vector<LogLine> lines = context.takeLines();
    ASSERT_EQ(lines.size(), 1u) << call;
    EXPECT_EQ(lines[0].severity, SUPPLE_SEVERITY_ERROR) << call;
    EXPECT_EQ(lines[0].message, SUPPLE_MESSAGE_DEVICE_LOST) << call << ": " << lines[0].text;
}

/// The state, reset, of a device whose timestamps the CPU reads: on CPU devices a buffer has them, and nothing can
/// fail.
WrappedVulkan& wrappedGpu() {
    WrappedVulkan& wrapped = wrappedVulkan();
    wrapped.deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    return wrapped;
}

TEST(DeviceLost, AFrameWhoseTimestampsCannotBeReadHasNotBegun) {
    wrappedGpu();
    const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
    ASSERT_NE(device, nullptr);
    LoggedContext context(*device);
    ASSERT_EQ(context.result(), SUPPLE_OK);
    SuppleAsset asset{};
    ASSERT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
    const SmallGroup small = createGroup(context.handle(), asset);
    context.evaluate({&small.group, 1}, SUPPLE_RECORD_TIMINGS);

    wrappedVulkan().queryFailure = VK_ERROR_OUT_OF_HOST_MEMORY;
    EXPECT_EQ(suppleBeginFrame(context.handle(), 2, 1), SUPPLE_ERROR_HOST_MEMORY);
    wrappedVulkan();
    EXPECT_EQ(suppleBeginFrame(context.handle(), 2, 1), SUPPLE_OK) << "the same frame again";
}

TEST(DeviceLost, StaysLostForTheContextAndForNoOther) {
    enum class Where { createBuffer, allocateMemory, queryResults };
    wrappedVulkan();
    std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
    ASSERT_NE(device, nullptr);
    const auto validation = device->validation();
    {
        LoggedContext healthy(*device);
        ASSERT_EQ(healthy.result(), SUPPLE_OK);
        SuppleAsset other{};
        ASSERT_EQ(createTube(healthy.handle(), other), SUPPLE_OK);
        const SmallGroup b = createGroup(healthy.handle(), other);
        for (const Where where : {Where::createBuffer, Where::allocateMemory, Where::queryResults}) {
            wrappedGpu();
            LoggedContext lost(*device);
            ASSERT_EQ(lost.result(), SUPPLE_OK);
            SuppleAsset asset{};
            ASSERT_EQ(createTube(lost.handle(), asset), SUPPLE_OK);
            const SmallGroup a = createGroup(lost.handle(), asset);
            lost.evaluate({&a.group, 1}, SUPPLE_RECORD_TIMINGS);
            healthy.evaluate({&b.group, 1});
            const std::vector<std::byte> bits = surfaceBits(healthy, b.group);
            EXPECT_EQ(lost.takeLines().size(), 0u);

            WrappedVulkan& wrapped = wrappedVulkan();
            SuppleAsset newAsset{77};
            SuppleGroup newGroup{77};
            SuppleGroupDesc groupDesc{};
            groupDesc.structSize = sizeof(groupDesc);
            groupDesc.asset = asset;
            groupDesc.capacity = 1;
            if (where == Where::createBuffer) {
                wrapped.failBuffer = 2;
                wrapped.bufferFailure = VK_ERROR_DEVICE_LOST;
                expectLost(lost, suppleCreateGroup(lost.handle(), &groupDesc, &newGroup), "suppleCreateGroup");
            } else if (where == Where::allocateMemory) {
                wrapped.failAllocation = 1;
                wrapped.allocationFailure = VK_ERROR_DEVICE_LOST;
                expectLost(lost, createTube(lost.handle(), newAsset), "suppleCreateAsset");
            } else {
                wrapped.queryFailure = VK_ERROR_DEVICE_LOST;
                expectLost(lost, suppleBeginFrame(lost.handle(), 2, 1), "suppleBeginFrame");
            }
            wrappedVulkan();

            // What needs the device says so again; the device itself is not asked.
            newAsset = {77};
            newGroup = {77};
            expectLost(lost, createTube(lost.handle(), newAsset), "suppleCreateAsset");
            expectLost(lost, suppleCreateGroup(lost.handle(), &groupDesc, &newGroup), "suppleCreateGroup");
            expectLost(lost, suppleBeginFrame(lost.handle(), 3, 2), "suppleBeginFrame");
            ASSERT_TRUE(device
                            ->submitAndWait([&](VkCommandBuffer commands) {
                                expectLost(lost, suppleRecordUploads(lost.handle(), commands), "suppleRecordUploads");
                                expectLost(lost, lost.record(commands, {&a.group, 1}), "suppleRecord");
                            })
                            .ok());
            EXPECT_EQ(currentWrappedVulkan().buffers + currentWrappedVulkan().allocations +
                          currentWrappedVulkan().barriers,
                      0u);
            // What does not need it works.
            EXPECT_EQ(suppleSetClipPose(lost.handle(), a.instances[0], 0, 0.5), SUPPLE_OK);
            EXPECT_EQ(outputOf(lost.handle(), a.group).info.capacity, 1u);

            healthy.evaluate({&b.group, 1});
            EXPECT_TRUE(surfaceBits(healthy, b.group) == bits) << "another context goes on";
            EXPECT_EQ(suppleDestroyGroup(lost.handle(), a.group), SUPPLE_OK);
            EXPECT_EQ(suppleDestroyAsset(lost.handle(), asset), SUPPLE_OK);
            EXPECT_EQ(lost.takeLines().size(), 0u);
        }
        // And while a context is created.
        WrappedVulkan& wrapped = wrappedVulkan();
        wrapped.failAllocation = 0;
        wrapped.allocationFailure = VK_ERROR_DEVICE_LOST;
        LoggedContext none(*device);
        EXPECT_EQ(none.handle(), nullptr);
        expectLost(none, none.result(), "suppleCreateContext");
    }
    device = nullptr;
    EXPECT_EQ(validation->messageCount(), 0u) << "something leaked";
}

} // namespace
} // namespace supple::test
