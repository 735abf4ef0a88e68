// Segments in their pool, against a table in plain memory: it is what the device would have.
#include "runtime/clip_stream.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace supple::test {
namespace {

using runtime::ClipRequest;
using runtime::ClipStream;
using skinning::ClipTable;

constexpr uint32_t kStreamedClips = 12, kSegmentsEach = 5, kTwinElement = 5, kFirstElement = 10;
constexpr VkDeviceSize kAmple = VkDeviceSize{1} << 20, kUnbounded = ~VkDeviceSize{0};

/// Clips of as many segments, of sizes at random.
std::shared_ptr<const ClipTable> segmentTable(std::mt19937& random) {
    auto table = std::make_shared<ClipTable>();
    table->segments = kFirstElement + kStreamedClips * kSegmentsEach;
    table->words.resize(4 * size_t{table->segments});
    uint32_t end = table->segments;
    for (uint32_t clip = 0; clip < kStreamedClips; ++clip) {
        table->streamedClips.push_back({clip, kTwinElement, kSegmentsEach * 32, clip * kSegmentsEach, kSegmentsEach});
        for (uint32_t s = 0; s < kSegmentsEach; ++s) {
            const uint32_t size = 3 + random() % 40, element = kFirstElement + clip * kSegmentsEach + s;
            table->streamedSegments.push_back({element, end, end + size / 3, end + size});
            const std::array<uint32_t, 4> words{end, end + size / 3, 32u, 0u};
            std::copy(words.begin(), words.end(), table->words.begin() + 4 * ptrdiff_t{element});
            end += size;
        }
    }
    table->words.resize(4 * size_t{end + 2});
    std::generate(table->words.begin() + 4 * ptrdiff_t{table->segments}, table->words.end(), std::ref(random));
    return table;
}

/// What a command buffer writes.
struct FakeTable {
    std::vector<uint32_t> words;
    std::vector<std::pair<VkDeviceSize, VkDeviceSize>> written; ///< bytes [first, end)
};
void VKAPI_PTR updateFake(VkCommandBuffer commands, VkBuffer, VkDeviceSize first, VkDeviceSize bytes,
                          const void* from) {
    FakeTable& table = *reinterpret_cast<FakeTable*>(commands);
    ASSERT_TRUE(first % 4 == 0 && bytes % 4 == 0 && bytes > 0 && bytes <= 65536);
    ASSERT_LE(first + bytes, 4 * table.words.size());
    std::memcpy(reinterpret_cast<std::byte*>(table.words.data()) + first, from, bytes);
    table.written.emplace_back(first, first + bytes);
}

struct SegmentPool {
    explicit SegmentPool(std::mt19937& random, double part)
        : whole(segmentTable(random)), stream(whole, poolOf(part)) {}
    [[nodiscard]] VkDeviceSize all() const { return 16 * VkDeviceSize{whole->words.size() / 4 - 2 - whole->segments}; }
    [[nodiscard]] VkDeviceSize poolOf(double part) const {
        return static_cast<VkDeviceSize>(part * static_cast<double>(all()));
    }
    void start() {
        device.words = stream.words();
        stream.start();
    }
    Status request(uint32_t clip, ClipRequest::Use use, double begin = 0.0, double end = 1.0) {
        return stream.request({clip, use, begin, end, ++stamp});
    }
    void begin(VkDeviceSize share) {
        ++frame;
        if (stream.beginFrame(frame, true)) {
            EXPECT_LE(stream.plan(share, share), share);
        }
    }
    VkDeviceSize record() {
        device.written.clear();
        const VkDeviceSize bytes =
            stream.record(gpu, reinterpret_cast<VkCommandBuffer>(&device), VK_NULL_HANDLE, frame, kUnbounded);
        std::sort(device.written.begin(), device.written.end());
        for (size_t k = 1; k < device.written.size(); ++k) { // no barriers lie between
            EXPECT_LE(device.written[k - 1].second, device.written[k].first);
        }
        return bytes;
    }
    void run(uint32_t frames, VkDeviceSize share = kAmple) {
        for (uint32_t k = 0; k < frames; ++k) {
            begin(share);
            EXPECT_LE(record(), share);
        }
    }
    [[nodiscard]] bool isThere(uint32_t segment) const {
        return stream.table().words[4 * size_t{whole->streamedSegments[segment].element} + 3] == 0u;
    }
    [[nodiscard]] VkDeviceSize there() const {
        VkDeviceSize sum = 0;
        for (uint32_t clip = 0; clip < kStreamedClips; ++clip) {
            sum += stream.bytesOf(clip).there;
        }
        return sum;
    }
    Status requestOne(uint32_t segment, ClipRequest::Use use) {
        const double at = (segment % kSegmentsEach + 0.5) / kSegmentsEach;
        return request(segment / kSegmentsEach, use, at, at);
    }
    /// Segments of which the device says another thing than the CPU, or that are not where it says.
    [[nodiscard]] uint32_t wrong() const {
        uint32_t count = 0;
        for (uint32_t s = 0; s < whole->streamedSegments.size(); ++s) {
            const skinning::StreamedSegment& own = whole->streamedSegments[s];
            const uint32_t* const element = &device.words[4 * size_t{own.element}];
            const bool same = (element[3] == 0u) == isThere(s) && element[2] == 32u &&
                              (!isThere(s) || (element[1] - element[0] == own.data - own.records &&
                                               std::equal(&device.words[4 * size_t{element[0]}],
                                                          &device.words[4 * size_t{element[0] + own.size()}],
                                                          &whole->words[4 * size_t{own.records}])));
            count += same ? 0 : 1;
        }
        return count;
    }

    std::shared_ptr<const ClipTable> whole;
    ClipStream stream;
    gpu::Device gpu = withUpdates();
    FakeTable device;
    uint64_t frame = 0, stamp = 0;

private:
    static gpu::Device withUpdates() {
        gpu::Device own;
        own.vk.CmdUpdateBuffer = updateFake;
        return own;
    }
};

TEST(ClipStreams, SayTheSameAsTheDeviceInEveryFrame) {
    for (uint32_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        SegmentPool own(random, 1.0 / (1 + seed % 4));
        const VkDeviceSize share = 64 + random() % 3000;
        uint32_t late = 0; // requests before the start are met at once
        for (uint32_t k = 0; k < 600; ++k) {
            late += k == seed % 8 ? 1 : 0;
            if (late == 1) {
                own.start();
                ++late;
            }
            if (late == 2) {
                own.begin(share);
            }
            for (uint32_t q = random() % 3; q > 0; --q) {
                const double begin = 0.01 * static_cast<double>(random() % 100);
                const uint32_t kind = random() % 10;
                const auto use = kind == 0  ? ClipRequest::Use::pinned
                                 : kind < 3 ? ClipRequest::Use::released
                                            : ClipRequest::Use::wanted;
                (void)own.request(random() % kStreamedClips, use, begin, std::min(1.0, begin + 0.4));
            }
            if (late == 0 || random() % 8 == 0) { // nobody records the asset
                continue;
            }
            const std::vector<uint32_t> before = own.device.words;
            const bool cancels = random() % 8 == 0, restarts = random() % 50 == 0;
            EXPECT_LE(own.record(), share);
            if (restarts) { // in the open frame, which may have recorded it or not
                own.stream.restart();
            }
            if (cancels) {
                own.device.words = before;
                own.stream.cancelFrame(own.frame);
            } else if (!restarts) {
                ASSERT_EQ(own.wrong(), 0u) << "frame " << own.frame;
            }
        }
    }
}

/// Whatever pieces the pool is in.
TEST(ClipStreams, HaveAllThatIsPinned) {
    for (uint32_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        SegmentPool own(random, 1.0 / 3.0);
        own.start();
        for (uint32_t clip = 0; clip < kStreamedClips; ++clip) {
            EXPECT_TRUE(own.request(clip, ClipRequest::Use::wanted));
            own.run(3);
        }
        std::vector<uint32_t> pinned;
        for (uint32_t k = 0; k < 60; ++k) {
            const uint32_t segment = random() % (kStreamedClips * kSegmentsEach);
            if (own.requestOne(segment, ClipRequest::Use::pinned)) {
                pinned.push_back(segment);
            }
            own.run(1, 700); // moves some and lets none go
        }
        own.run(20, 700);
        for (const uint32_t segment : pinned) {
            EXPECT_TRUE(own.isThere(segment)) << segment;
        }
        EXPECT_EQ(own.wrong(), 0u);
    }
}

TEST(ClipStreams, OfAPoolForAllHaveAll) {
    for (const VkDeviceSize share : {kAmple, VkDeviceSize{100}}) { // the second is less than most segments take
        for (uint32_t seed = 0; seed < 100; ++seed) {
            SCOPED_TRACE(seed);
            std::mt19937 random(seed);
            SegmentPool own(random, 1.0);
            own.start();
            for (uint32_t k = 0; k < 120; ++k) {
                own.begin(400);
                const double begin = 0.01 * static_cast<double>(random() % 100);
                const auto use = random() % 2 == 0 ? ClipRequest::Use::released : ClipRequest::Use::wanted;
                EXPECT_TRUE(own.request(random() % kStreamedClips, use, begin, std::min(1.0, begin + 0.3)));
                own.record();
            }
            for (uint32_t clip = 0; clip < kStreamedClips; ++clip) {
                EXPECT_TRUE(own.request(clip, ClipRequest::Use::wanted));
            }
            for (uint32_t k = 0; k < 2000 && own.there() < own.all(); ++k) {
                own.run(1, share);
            }
            EXPECT_EQ(own.there(), own.all());
            EXPECT_EQ(own.wrong(), 0u);
        }
    }
}

/// What is pinned plays on while others that need room in one piece push it about.
TEST(ClipStreams, PlayWhileTheyMove) {
    uint32_t moves = 0;
    for (uint32_t seed = 0; seed < 50; ++seed) {
        std::mt19937 random(seed);
        SegmentPool own(random, 0.5);
        own.start();
        const auto ask = [&](ClipRequest::Use use) {
            const uint32_t segment = random() % (kStreamedClips * kSegmentsEach);
            EXPECT_TRUE(own.requestOne(segment, use));
            return segment;
        };
        std::vector<uint32_t> pinned;
        while (pinned.size() < 10) {
            const uint32_t other = ask(ClipRequest::Use::wanted); // no longer pinned, if it was
            std::erase(pinned, other);
            pinned.push_back(ask(ClipRequest::Use::pinned));
            own.run(1);
        }
        own.run(3);
        for (uint32_t frame = 0; frame < 100; ++frame) {
            const std::vector<uint32_t> before = own.device.words;
            const uint32_t asked = random() % (kStreamedClips * kSegmentsEach);
            if (std::find(pinned.begin(), pinned.end(), asked) == pinned.end()) {
                EXPECT_TRUE(own.requestOne(asked, ClipRequest::Use::wanted));
            }
            own.run(1);
            EXPECT_EQ(own.wrong(), 0u);
            for (const uint32_t s : pinned) {
                const size_t element = 4 * size_t{own.whole->streamedSegments[s].element};
                EXPECT_TRUE(own.isThere(s));
                moves += before[element] != own.device.words[element] ? 1 : 0;
            }
        }
    }
    EXPECT_GT(moves, 50u);
}

TEST(ClipStreams, ComeHoweverSeldomTheAssetIsRecorded) {
    std::mt19937 random(3);
    SegmentPool own(random, 1.0);
    own.start();
    for (uint32_t clip = 0; clip < kStreamedClips; ++clip) {
        EXPECT_TRUE(own.request(clip, ClipRequest::Use::wanted));
    }
    for (uint32_t k = 0; k < 400; ++k) {
        own.begin(1000);
        if (k % 20 == 0) {
            own.record();
        }
    }
    EXPECT_GT(own.there(), 15u * 1000u);
}

TEST(ClipStreams, ThatAreCancelledAfterARestartAreWrittenAgain) {
    std::mt19937 random(4);
    SegmentPool own(random, 1.0);
    EXPECT_TRUE(own.request(0, ClipRequest::Use::wanted));
    EXPECT_TRUE(own.request(1, ClipRequest::Use::wanted));
    own.start();
    own.begin(kAmple);
    own.record();
    own.stream.restart(); // their twins
    const std::vector<uint32_t> before = own.device.words;
    own.record();
    own.device.words = before;
    own.stream.cancelFrame(own.frame);
    EXPECT_TRUE(own.request(1, ClipRequest::Use::wanted));
    own.run(1);
    EXPECT_EQ(own.wrong(), 0u);
    own.run(3);
    EXPECT_EQ(own.wrong(), 0u);
    EXPECT_EQ(own.there(), own.stream.bytesOf(1).all);
}

/// A clip's number says when it changed last.
TEST(ClipStreams, TellWhichClipsHaveChanged) {
    std::mt19937 random(5);
    SegmentPool own(random, 1.0);
    own.start();
    const uint64_t before = own.stream.version();
    EXPECT_TRUE(own.request(3, ClipRequest::Use::wanted));
    own.run(3);
    EXPECT_GT(own.stream.version(), before);
    for (uint32_t clip = 0; clip < kStreamedClips; ++clip) {
        EXPECT_EQ(own.stream.versionOf(clip) > before, clip == 3);
    }
}

/// The table is not made before a group is there: what is asked for till then is in it.
TEST(ClipStreams, MakeTheirBeginningAnewUntilTheyStart) {
    std::mt19937 random(6);
    SegmentPool own(random, 0.5);
    EXPECT_TRUE(own.request(0, ClipRequest::Use::wanted));
    own.device.words = own.stream.words(); // for a group that is refused
    const uint64_t version = own.stream.version();
    for (uint32_t clip = 1; clip < kStreamedClips; ++clip) {
        EXPECT_TRUE(own.request(clip, ClipRequest::Use::wanted));
    }
    EXPECT_NE(own.stream.version(), version);
    own.start();
    EXPECT_EQ(own.wrong(), 0u);
    EXPECT_EQ(own.stream.bytesOf(kStreamedClips - 1).there, own.stream.bytesOf(kStreamedClips - 1).all);
}

} // namespace
} // namespace supple::test
