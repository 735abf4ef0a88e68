// Frames without end: instances, groups and assets come and go by a timetable. After each of its rounds the memory is
// what it was, and the surface has the bits it had.
#include "tests/support/host_memory.h"
#include "tests/support/logged_context.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace supple::test {
namespace {

constexpr uint64_t kRound = 500; // frames

/// SUPPLE_SOAK_FRAMES, or what a test has time for.
uint64_t framesWanted() {
    const char* given = std::getenv("SUPPLE_SOAK_FRAMES");
    return given != nullptr ? std::strtoull(given, nullptr, 10) : 20000;
}

class Soak {
public:
    explicit Soak(host::Device& device) : device_(device), context_(device) {
        EXPECT_EQ(createTube(handle(), asset_), SUPPLE_OK);
        posed_ = createGroup(handle(), asset_, {.flags = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_BOUNDS, .capacity = 3});
        played_ = createGroup(handle(), asset_, {.capacity = 2, .poseSource = SUPPLE_POSES_PLAYBACK});
        EXPECT_EQ(posed_.result, SUPPLE_OK);
        EXPECT_EQ(played_.result, SUPPLE_OK);
    }

    /// One round; false where a call failed.
    bool round() {
        for (uint64_t at = 0; at < kRound && good_; ++at) {
            frame(at);
        }
        return good_;
    }

    [[nodiscard]] std::vector<std::byte> bits() const { return surfaceBits(context_, posed_.group); }

    [[nodiscard]] uint64_t deviceMemory() const {
        SuppleMemoryUse use{};
        use.structSize = sizeof(use);
        EXPECT_EQ(suppleGetContextMemory(handle(), &use), SUPPLE_OK);
        return use.deviceLocal + use.hostVisible;
    }

private:
    [[nodiscard]] SuppleContext handle() const { return context_.handle(); }
    void ok(SuppleResult result) { good_ = good_ && result == SUPPLE_OK; }

    void frame(uint64_t at) {
        ++frame_;
        // Every third frame those before are still on their way; the last of a round waits for all.
        const uint64_t behind = at % 3 == 2 && at + 2 < kRound ? 2 : 1;
        ok(suppleBeginFrame(handle(), frame_, frame_ - behind));
        change(at);
        pose(at);
        if (at % 97 == 96) {
            ok(suppleCancelFrame(handle()));
            return;
        }
        std::vector<SuppleGroup> groups{posed_.group, played_.group};
        if (guest_.group.id != 0) {
            groups.push_back(guest_.group);
        }
        good_ = device_
                    .submitAndWait([&](VkCommandBuffer commands) {
                        ok(context_.record(commands, groups, at % 2 == 0 ? SUPPLE_RECORD_TIMINGS : 0));
                    })
                    .ok() &&
                good_;
    }

    void change(uint64_t at) {
        switch (at % 100) {
        case 10:
            guest_ = createGroup(handle(), asset_, {.scheme = at < 250 ? SUPPLE_SCHEME_PM : SUPPLE_SCHEME_POLYGONS});
            ok(guest_.result);
            break;
        case 40:
            ok(suppleSetCapacity(handle(), guest_.group, at / 100 + 2));
            break;
        case 60:
            ok(suppleDestroyGroup(handle(), guest_.group));
            guest_ = {};
            break;
        case 70: {
            SuppleAsset passing{};
            ok(createTube(handle(), passing));
            ok(suppleDestroyAsset(handle(), passing));
            break;
        }
        case 80:
            ok(suppleSetCapacity(handle(), posed_.group, 4));
            break;
        case 90:
            ok(suppleSetCapacity(handle(), posed_.group, 3));
            break;
        default:
            break;
        }
        SuppleInstance& passing = posed_.instances[at % 2]; // back in the same slot
        ok(suppleDestroyInstance(handle(), passing));
        ok(suppleCreateInstance(handle(), posed_.group, &passing));
        ok(suppleSetVisible(handle(), posed_.instances[2], at % 7 < 5 ? 1 : 0));
    }

    void pose(uint64_t at) {
        for (size_t i = 0; i < posed_.instances.size(); ++i) {
            ok(suppleSetClipPose(handle(), posed_.instances[i], 0, 0.01 * static_cast<double>(at + i)));
        }
        SupplePlaybackLayer layer{};
        layer.weight = layer.speed = 1.0f;
        SupplePlaybackDesc desc{};
        desc.structSize = sizeof(desc);
        desc.layers = &layer;
        desc.layerCount = 1;
        for (const SuppleInstance instance : played_.instances) {
            ok(suppleSetPlayback(handle(), instance, &desc));
        }
        ok(suppleSetTime(handle(), played_.group, 0.02 * static_cast<double>(at)));
    }

    host::Device& device_;
    LoggedContext context_;
    SuppleAsset asset_{};
    SmallGroup posed_, played_, guest_;
    uint64_t frame_ = 0;
    bool good_ = true;
};

TEST(Soak, RoundsAreAlikeAndTakeNothing) {
    const std::unique_ptr<host::Device> device = deviceThrough(nullptr, false);
    ASSERT_NE(device, nullptr);
    Soak soak(*device);
    ASSERT_TRUE(soak.round());
    ASSERT_TRUE(soak.round());
    const std::vector<std::byte> bits = soak.bits();
    const uint64_t deviceMemory = soak.deviceMemory();
    ASSERT_FALSE(bits.empty());
    const uint64_t rounds = framesWanted() / kRound;
    resetHostMemory();
    for (uint64_t n = 2; n < rounds; ++n) {
        ASSERT_TRUE(soak.round()) << "round " << n;
        ASSERT_TRUE(soak.bits() == bits) << "round " << n;
        ASSERT_EQ(soak.deviceMemory(), deviceMemory) << "round " << n;
    }
    // Lists find their size in the first rounds; a leak of ten bytes a frame would be seen.
    EXPECT_LT(hostMemory().live, 100000);
    std::printf("  %llu frames, %lld bytes of host memory more than after the first thousand\n",
                static_cast<unsigned long long>(rounds * kRound), static_cast<long long>(hostMemory().live));
}

} // namespace
} // namespace supple::test
