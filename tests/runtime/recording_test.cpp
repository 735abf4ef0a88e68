// Recordings: what a host did to a context, done again by another one, has the same hashes.
#include "tests/support/any_host.h"
#include "tests/support/recordings.h"
#include "tools/common/word_hash.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <set>
#include <supple/supple_recording.h>
#include <vector>

namespace supple::test {
namespace {

using runtime::RecordingReader;

class Recordings : public CrowdContexts {};

constexpr uint32_t kHostFrames = 40;
constexpr std::array kNarrow = {SUPPLE_MAPPING_NARROW}, kWide = {SUPPLE_MAPPING_WIDE};

/// What the host has recorded that did something by `seed`, beginning with frame `first` (0: before anything is
/// created).
Recorded recordedHost(host::Device& device, SuppleMapping mapping, uint32_t seed, uint32_t first, uint32_t frames,
                      uint32_t flags = 0) {
    Recorded recorded;
    CrowdContext context(device, mapping, 2, first > 0 ? flags | SUPPLE_CONTEXT_RECORDABLE : flags);
    if (first == 0) {
        EXPECT_EQ(recorded.start(context.handle()), SUPPLE_OK);
    }
    AnyHost host(context, seed);
    for (uint32_t frame = 1; frame <= frames; ++frame) {
        if (frame == first) {
            context.beginFrame(); // one that has recorded nothing
            EXPECT_EQ(recorded.start(context.handle()), SUPPLE_OK);
        }
        host.run(frame);
    }
    context.beginFrame(); // the last one is complete
    EXPECT_EQ(suppleStopRecording(context.handle()), SUPPLE_OK);
    return recorded;
}

TEST_F(Recordings, MadeAgainHaveTheSameHashes) {
    std::set<size_t> calls;
    for (const uint32_t seed : {1u, 2u, 3u}) {
        const Recorded recorded = recordedHost(*testDevice(), SUPPLE_MAPPING_NARROW, seed, 0, kHostFrames);
        const ReadRecording own = expectReplayed(recorded, 301, kNarrow);
        calls.insert(own.calls.begin(), own.calls.end());
    }
    for (size_t call = 0; call < runtime::kCallNames.size(); ++call) {
        EXPECT_TRUE(calls.contains(call) || call == runtime::kCallNumber<runtime::calls::SetDepthPyramid>)
            << runtime::kCallNames[call] << " was never made";
    }
}

TEST_F(Recordings, HaveTheSameHashesInTheOtherMapping) {
    const Recorded recorded = recordedHost(*testDevice(), SUPPLE_MAPPING_NARROW, 4, 0, 12);
    expectReplayed(recorded, 90, kWide);
}

TEST_F(Recordings, HaveTheSameHashesWhereGroupsShareDispatches) {
    const Recorded recorded =
        recordedHost(*testDevice(), SUPPLE_MAPPING_WIDE, 8, 0, 8, SUPPLE_CONTEXT_SHARED_DISPATCHES);
    expectReplayed(recorded, 60, kNarrow);
}

TEST_F(Recordings, MayBeginAgain) {
    CrowdContext context(*testDevice(), SUPPLE_MAPPING_NARROW, 2, SUPPLE_CONTEXT_RECORDABLE);
    AnyHost host(context, 9);
    for (uint32_t frame = 1; frame <= 12; frame += 3) {
        Recorded recorded;
        context.beginFrame();
        ASSERT_EQ(recorded.start(context.handle()), SUPPLE_OK);
        host.run(frame);
        host.run(frame + 1);
        context.beginFrame();
        ASSERT_EQ(suppleStopRecording(context.handle()), SUPPLE_OK);
        host.run(frame + 2);
        expectReplayed(recorded, 6, kNarrow);
    }
}

TEST_F(Recordings, ThatBeginLateBeginWithWhatThereIs) {
    for (const uint32_t first : {1u, 2u, 7u, 16u, 31u}) {
        SCOPED_TRACE(first);
        const Recorded recorded = recordedHost(*testDevice(), SUPPLE_MAPPING_NARROW, 10 + first, first, first + 8);
        expectReplayed(recorded, 51, kNarrow);
    }
}

TEST_F(Recordings, HashWhatTheDeviceWrote) {
    CrowdContext context(*testDevice(), SUPPLE_MAPPING_NARROW);
    Recorded recorded;
    ASSERT_EQ(recorded.start(context.handle()), SUPPLE_OK);
    SuppleGroupDesc desc{};
    desc.asset = context.createAsset(tubeFile(), "tube");
    desc.scheme = SUPPLE_SCHEME_CATMULL_CLARK;
    desc.rate = 5;
    desc.capacity = 1;
    Crowd crowd(context, desc);
    const SuppleInstance instance = crowd.spawn();
    ASSERT_EQ(suppleSetClipPose(context.handle(), instance, 0, 0.7), SUPPLE_OK);
    context.run(crowd.group());
    const host::GroupOutput output = crowd.output();
    const std::vector<std::byte> poses = crowd.read(output.info.poses), cage = crowd.read(output.info.deformedCage),
                                 vertices = crowd.read(output.streams.vertices);
    context.beginFrame();
    ASSERT_EQ(suppleStopRecording(context.handle()), SUPPLE_OK);

    tools::WordHash ofPoses, ofCage, ofVertices;
    constexpr size_t kPoseWords = 3 * 12 + 4; // joints, morph weights
    ofPoses.add(std::span(poses).first(sizeof(float) * kPoseWords));
    ofCage.add(std::span(cage).first(size_t{16} * output.info.cageVertexCount));
    for (uint32_t v = 0; v < output.grid.vertexCount; ++v) {
        ofVertices.add(std::span(vertices).subspan(size_t{v} * output.streams.vertices.stride, 12));
    }
    const Hashes hashes = read(recorded.bytes).hashes;
    ASSERT_EQ(hashes.size(), 3u);
    const tools::WordHash own[] = {ofPoses, ofCage, ofVertices};
    for (uint32_t stage = 0; stage < 3; ++stage) {
        const auto found = hashes.find({1, crowd.group().id, stage, 0});
        ASSERT_NE(found, hashes.end());
        EXPECT_EQ(found->second[0] | uint64_t{found->second[1]} << 32u, own[stage].value()) << "stage " << stage;
    }
}

TEST_F(Recordings, ShowWhereAnotherPoseIsPlayed) {
    Recorded recorded = recordedHost(*testDevice(), SUPPLE_MAPPING_NARROW, 5, 0, 6);
    const Hashes own = read(recorded.bytes).hashes;
    // The time of frame 4, a little later.
    const double time = 4 * 0.03;
    std::array<std::byte, sizeof(time)> bytes{};
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        sum += 0.03;
    }
    std::memcpy(bytes.data(), &sum, sizeof(sum));
    const auto found = std::search(recorded.bytes.begin(), recorded.bytes.end(), bytes.begin(), bytes.end());
    ASSERT_NE(found, recorded.bytes.end());
    const double later = time + 0.01;
    std::memcpy(&*found, &later, sizeof(later));
    const Hashes other = replay(*testDevice(), recorded.bytes);
    std::set<uint64_t> frames;
    for (const auto& [key, sums] : own) {
        const auto here = other.find(key);
        if (here != other.end() && here->second != sums) {
            frames.insert(std::get<0>(key));
        }
    }
    EXPECT_EQ(frames, std::set<uint64_t>{4});
}

TEST_F(Recordings, EndIfTheHostTakesNoMore) {
    CrowdContext context(*testDevice());
    Recorded recorded;
    recorded.refusedAfter = 2;
    ASSERT_EQ(recorded.start(context.handle()), SUPPLE_OK);
    for (int i = 0; i < 4; ++i) {
        context.beginFrame();
    }
    EXPECT_EQ(context.takeCount(SUPPLE_MESSAGE_RECORDING_ENDED), 1u);
    EXPECT_EQ(suppleStopRecording(context.handle()), SUPPLE_ERROR_ARGUMENT);
    EXPECT_FALSE(read(recorded.bytes).ended);
}

TEST_F(Recordings, WithoutCharactersTakeThemFromTheHost) {
    CrowdContext context(*testDevice());
    Recorded recorded;
    ASSERT_EQ(recorded.start(context.handle(), SUPPLE_RECORDING_HASHES | SUPPLE_RECORDING_WITHOUT_ASSETS), SUPPLE_OK);
    SuppleGroupDesc desc{};
    desc.asset = context.createAsset(tubeFile(), "tube");
    desc.capacity = 1;
    desc.rate = 2;
    Crowd crowd(context, desc);
    (void)crowd.spawn();
    context.run(crowd.group());
    context.beginFrame();
    ASSERT_EQ(suppleStopRecording(context.handle()), SUPPLE_OK);
    EXPECT_LT(recorded.bytes.size(), 4096u);
    const Hashes own = read(recorded.bytes).hashes;
    tools::Replayer::Options options;
    options.characters.emplace_back("the same tube", tubeFile());
    EXPECT_EQ(expectSame(own, replay(*testDevice(), recorded.bytes, options)), 3u);
}

/// Whatever is cut off or changed, reading it ends.
TEST_F(Recordings, MayBeDamaged) {
    const Recorded whole = recordedHost(*testDevice(), SUPPLE_MAPPING_NARROW, 6, 0, 4);
    const auto readAll = [](std::span<const std::byte> bytes) {
        size_t events = 0;
        Result<RecordingReader> reader = RecordingReader::open(bytes, "damaged");
        for (bool more = reader.ok(); more;) {
            const auto event = reader->next();
            more = event.ok() && event->has_value();
            events += more ? 1 : 0;
        }
        return events;
    };
    const size_t all = readAll(whole.bytes);
    size_t last = 0;
    for (size_t length = 0; length < whole.bytes.size(); length += 509) {
        const size_t events = readAll(std::span(whole.bytes).first(length));
        EXPECT_GE(events, last);
        last = events;
    }
    EXPECT_LT(last, all);
    std::mt19937 random(7);
    for (int i = 0; i < 2000; ++i) {
        std::vector<std::byte> bytes = whole.bytes;
        for (int k = 0; k < 4; ++k) {
            bytes[random() % bytes.size()] ^= static_cast<std::byte>(1u << random() % 8);
        }
        EXPECT_LE(readAll(bytes), all + 4);
    }
}

TEST_F(Recordings, AreRefusedWhereTheyLackTheBeginning) {
    CrowdContext context(*testDevice());
    (void)context.createAsset(tubeFile(), "tube");
    Recorded recorded;
    EXPECT_EQ(recorded.start(context.handle()), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(context.takeError(), SUPPLE_MESSAGE_OUT_OF_ORDER);
    EXPECT_EQ(suppleStopRecording(context.handle()), SUPPLE_ERROR_ARGUMENT);
    CrowdContext fresh(*testDevice());
    EXPECT_EQ(recorded.start(fresh.handle()), SUPPLE_OK);
    EXPECT_EQ(recorded.start(fresh.handle()), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleStopRecording(fresh.handle()), SUPPLE_OK);
    EXPECT_EQ(recorded.start(fresh.handle()), SUPPLE_OK);
}

} // namespace
} // namespace supple::test
