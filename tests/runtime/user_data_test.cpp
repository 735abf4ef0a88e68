// The host's own four floats per instance: what the device has of them, when they are uploaded, and that frames in
// flight keep theirs.
#include "runtime/slot_values.h"
#include "tests/support/crowd.h"

#include <array>
#include <cstring>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

using Value = std::array<float, 4>;
constexpr Value kZero{}, kRed{1.0f, 0.0f, 0.0f, 1.0f}, kGreen{0.0f, 1.0f, 0.0f, 0.5f}, kOdd{-0.0f, 1e30f, -3.0f, 0.25f};

class UserData : public CrowdContexts {
protected:
    void SetUp() override {
        CrowdContexts::SetUp();
        if (!HasFatalFailure()) {
            own = &context(SUPPLE_MAPPING_AUTO);
            ASSERT_TRUE(own->valid());
            ASSERT_EQ(createTube(own->handle(), asset), SUPPLE_OK);
        }
    }
    /// Nothing but the host's data is uploaded unless instances change.
    [[nodiscard]] SuppleGroupDesc desc(uint32_t capacity) const {
        SuppleGroupDesc desc{};
        desc.asset = asset;
        desc.capacity = capacity;
        desc.scheme = SUPPLE_SCHEME_CAGE;
        desc.poseSource = SUPPLE_POSES_CAGE_BUFFER;
        return desc;
    }
    void set(SuppleInstance instance, const Value& value) const {
        EXPECT_EQ(suppleSetUserData(own->handle(), instance, value.data()), SUPPLE_OK);
    }
    [[nodiscard]] static Value onDevice(const Crowd& crowd, uint32_t slot) {
        const std::vector<Value> all = as<Value>(crowd.read(crowd.output().info.userData));
        return all.at(slot);
    }
    CrowdContext* own = nullptr;
    SuppleAsset asset{};
};

TEST_F(UserData, IsZeroUntilItIsSet) {
    const ValidationGuard guard;
    Crowd crowd(*own, desc(3));
    ASSERT_TRUE(crowd.valid());
    const SuppleBufferRange range = crowd.output().info.userData;
    EXPECT_EQ(range.stride, 16u);
    EXPECT_EQ(range.size, 48u);
    const SuppleInstance a = crowd.spawn(), b = crowd.spawn();
    crowd.run();
    EXPECT_EQ(onDevice(crowd, 0), kZero);
    EXPECT_EQ(onDevice(crowd, 1), kZero);
    set(b, kRed);
    crowd.run();
    EXPECT_EQ(onDevice(crowd, 0), kZero);
    EXPECT_EQ(onDevice(crowd, 1), kRed);
    set(a, kOdd);
    set(b, kGreen);
    crowd.run();
    crowd.run();
    EXPECT_EQ(onDevice(crowd, 0), kOdd);
    EXPECT_EQ(onDevice(crowd, 1), kGreen);

    crowd.destroy(b);
    const SuppleInstance again = crowd.spawn();
    EXPECT_EQ(again.slot, b.slot);
    crowd.run();
    EXPECT_EQ(onDevice(crowd, 1), kZero) << "a new instance has none of the old one's";
    EXPECT_EQ(suppleSetUserData(own->handle(), b, kRed.data()), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(own->takeError(), SUPPLE_MESSAGE_STALE_HANDLE);
}

TEST_F(UserData, IsUploadedWhenItChanges) {
    const ValidationGuard guard;
    Crowd crowd(*own, desc(10));
    ASSERT_TRUE(crowd.valid());
    std::vector<SuppleInstance> all;
    for (int i = 0; i < 8; ++i) {
        all.push_back(crowd.spawn());
    }
    for (int frame = 0; frame < 3; ++frame) {
        (void)own->uploadedFor(crowd.group());
    }
    EXPECT_EQ(own->uploadedFor(crowd.group()), 0u);
    set(all[2], kRed);
    EXPECT_EQ(own->uploadedFor(crowd.group()), 16u);
    EXPECT_EQ(own->uploadedFor(crowd.group()), 0u);
    set(all[2], kRed);
    EXPECT_EQ(own->uploadedFor(crowd.group()), 0u) << "the same again";
    set(all[6], kGreen);
    set(all[3], kGreen);
    EXPECT_EQ(own->uploadedFor(crowd.group()), 64u) << "slots 3 to 6";
    EXPECT_EQ(onDevice(crowd, 2), kRed);
    EXPECT_EQ(onDevice(crowd, 3), kGreen);
    EXPECT_EQ(onDevice(crowd, 5), kZero);
    EXPECT_EQ(onDevice(crowd, 6), kGreen);
}

TEST_F(UserData, ACancelledFrameIsRepeated) {
    const ValidationGuard guard;
    Crowd crowd(*own, desc(2));
    ASSERT_TRUE(crowd.valid());
    const SuppleInstance a = crowd.spawn();
    crowd.run();
    set(a, kRed);
    own->cancel(crowd.group());
    crowd.run();
    EXPECT_EQ(onDevice(crowd, 0), kRed);
}

TEST_F(UserData, FramesInFlightKeepTheirs) {
    const ValidationGuard guard;
    Crowd crowd(*own, desc(2));
    ASSERT_TRUE(crowd.valid());
    const SuppleInstance a = crowd.spawn();
    crowd.run();
    const SuppleGroup group = crowd.group();
    const SuppleBufferRange range = crowd.output().info.userData;
    struct Flight {
        explicit Flight(host::Device& device) : commands(device) {}
        host::Buffer copy; ///< outlives the commands
        Commands commands;
    };
    Flight flights[2]{Flight(own->device()), Flight(own->device())};
    const Value values[2] = {kRed, kGreen};
    for (int f = 0; f < 2; ++f) { // both are recorded before either runs
        Result<host::Buffer> copy =
            own->device().createBuffer(range.size, VK_BUFFER_USAGE_TRANSFER_DST_BIT, host::MemoryKind::upload);
        ASSERT_TRUE(copy.ok());
        flights[f].copy = std::move(*copy);
        set(a, values[f]);
        ++own->frame;
        ASSERT_EQ(suppleBeginFrame(own->handle(), own->frame, own->frame - (f == 0 ? 1 : 2)), SUPPLE_OK);
        flights[f].commands.record([&](VkCommandBuffer commands) {
            EXPECT_EQ(own->record(commands, {&group, 1}), SUPPLE_OK);
            const VkBufferCopy region{range.offset, 0, range.size};
            vkCmdCopyBuffer(commands, range.buffer, flights[f].copy.handle(), 1, &region);
            host::memoryBarrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                                {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
        });
    }
    set(a, kOdd); // of a frame that is not recorded yet
    for (Flight& flight : flights) {
        flight.commands.submit();
    }
    for (int f = 0; f < 2; ++f) {
        flights[f].commands.wait();
        Value read{};
        std::memcpy(read.data(), flights[f].copy.mapped(), sizeof(read));
        EXPECT_EQ(read, values[f]);
    }
    crowd.run();
    EXPECT_EQ(onDevice(crowd, 0), kOdd);
}

/// For who makes a set of instances larger.
TEST(UserDataCopies, TakeWhatASmallerSetHas) {
    runtime::UserData small(2), large(5);
    small.set(1, kRed);
    large.set(4, kGreen);
    large.takeFrom(small, 2);
    EXPECT_EQ(large.values(), (std::vector<Value>{kZero, kRed, kZero, kZero, kGreen}));
}

} // namespace
} // namespace supple::test
