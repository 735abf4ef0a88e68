// Clips whose segments come and go (suppleRequestClip): what plays has the bits of the CPU's getters whatever is there,
// and those of a clip that was never streamed once all is.
#include "runtime/cooked/file.h"
#include "tests/support/crowd.h"
#include "tests/support/played_group.h"
#include "tests/support/read_character.h"
#include "tests/support/recordings.h"
#include "tests/support/sample_assets.h"
#include "tests/support/worst.h"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <random>
#include <supple/supple_prepare.h>

namespace supple::test {
namespace {

class StreamedClips : public CrowdContexts {};

constexpr double kFine = 1e-4, kCoarse = 1e-2;
constexpr uint64_t kWholePool = uint64_t{1} << 30;
constexpr uint32_t kMostAwaited = 4000;

/// A cooked file whose clips have coarse twins.
const std::vector<std::byte>& twinned(const std::string& file) {
    static std::map<std::string, std::vector<std::byte>> files;
    std::vector<std::byte>& bytes = files[file];
    if (bytes.empty()) {
        const std::shared_ptr<runtime::Prepared> prepared = runtime::Prepared::of(readCharacter(file));
        prepared->packClips(kFine, kCoarse);
        bytes = runtime::writeCooked(*prepared, "");
    }
    return bytes;
}

SuppleAssetDesc describe(const std::string& file, uint64_t pool) {
    SuppleAssetDesc desc{};
    desc.structSize = sizeof desc;
    desc.name = "streamed";
    desc.bytes = twinned(file).data();
    desc.byteCount = twinned(file).size();
    desc.clipPoolBytes = pool;
    return desc;
}

SuppleAsset createStreamed(CrowdContext& context, const std::string& file, uint64_t pool) {
    const SuppleAssetDesc desc = describe(file, pool);
    SuppleAsset asset{};
    EXPECT_EQ(suppleCreateAsset(context.handle(), &desc, &asset), SUPPLE_OK);
    return asset;
}

SuppleClipInfo infoOf(CrowdContext& context, SuppleAsset asset, uint32_t clip) {
    SuppleClipInfo info{};
    info.structSize = sizeof info;
    EXPECT_EQ(suppleGetClipInfo(context.handle(), asset, clip, &info), SUPPLE_OK);
    return info;
}
uint64_t residentIn(CrowdContext& context, SuppleAsset asset, uint32_t clips) {
    uint64_t sum = 0;
    for (uint32_t clip = 0; clip < clips; ++clip) {
        sum += infoOf(context, asset, clip).residentBytes;
    }
    return sum;
}

SuppleResult request(CrowdContext& context, SuppleAsset asset, uint32_t clip, SuppleClipUse use = SUPPLE_CLIP_REQUEST,
                     double begin = 0.0, double end = 0.0) {
    const SuppleClipRequest request{sizeof request, use, begin, end};
    return suppleRequestClip(context.handle(), asset, clip, &request);
}

uint64_t frameBytesOf(const CrowdContext& context) {
    SuppleUploadState state{};
    state.structSize = sizeof state;
    EXPECT_EQ(suppleGetUploadState(context.handle(), &state), SUPPLE_OK);
    return state.frameBytes;
}

/// How far joints of two groups' instances are apart at most.
double jointsApart(const PlayedGroup& a, const PlayedGroup& b, uint32_t instances) {
    double most = 0.0;
    for (uint32_t i = 0; i < instances; ++i) {
        for (uint32_t j = 0; j < a.character().skin.joints.size(); ++j) {
            raise(most, glm::length(a.placeOf(i, j) - b.placeOf(i, j)));
        }
    }
    return most;
}

TEST_F(StreamedClips, PlayTheirTwinsUntilTheyAreThere) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        for (const std::string& file : {kPip, kWren}) {
            SCOPED_TRACE(std::string(mappingName(mapping)) + " " + file);
            const SuppleAsset asset = createStreamed(own, file, kWholePool);
            PlayedGroup streamed(own, playedGroup(asset, 3, SUPPLE_GROUP_TRANSITIONS));
            PlayedGroup whole(own, playedGroup(createStreamed(own, file, 0), 3, SUPPLE_GROUP_TRANSITIONS));
            ASSERT_TRUE(streamed.crowd.valid() && whole.crowd.valid());
            const uint32_t clips = streamed.crowd.clipCount();
            for (uint32_t i = 0; i < 3; ++i) {
                streamed.play(i, i % clips, 0.17 * i);
                whole.play(i, i % clips, 0.17 * i);
            }
            uint64_t all = 0;
            for (uint32_t clip = 0; clip < clips; ++clip) {
                const SuppleClipInfo info = infoOf(own, asset, clip);
                EXPECT_GT(info.coarseError, info.packedError);
                EXPECT_LE(info.coarseError, kCoarse);
                EXPECT_EQ(info.residentBytes, 0u);
                EXPECT_GT(info.segmentBytes, 0u);
                EXPECT_LT(info.segmentBytes, info.byteCount);
                all += info.segmentBytes;
            }
            for (const double time : {0.0, 0.35, 1.0, 17.3}) {
                EXPECT_EQ(streamed.run(time), 0u) << time;
                EXPECT_EQ(whole.run(time), 0u) << time;
                const double off = jointsApart(streamed, whole, 3);
                EXPECT_GT(off, 0.0);
                EXPECT_LT(off, 1.5 * kCoarse * streamed.extent());
            }
            for (uint32_t clip = 0; clip < clips; ++clip) {
                EXPECT_EQ(request(own, asset, clip), SUPPLE_OK);
            }
            EXPECT_EQ(streamed.run(2.0), 0u);
            EXPECT_EQ(frameBytesOf(own), all) << "less than 64 KiB go up in one frame";
            EXPECT_EQ(residentIn(own, asset, clips), 0u) << "they play from the next frame on";
            EXPECT_EQ(streamed.run(2.1), 0u);
            EXPECT_EQ(whole.run(2.1), 0u);
            EXPECT_EQ(residentIn(own, asset, clips), all);
            EXPECT_EQ(jointsApart(streamed, whole, 3), 0.0);
            EXPECT_EQ(streamed.poses, whole.poses);
        }
    }
}

TEST_F(StreamedClips, AreThereFromTheBeginningIfTheyWereAskedForBefore) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = createStreamed(own, kPip, kWholePool);
    EXPECT_EQ(suppleRequestClip(own.handle(), asset, 1, nullptr), SUPPLE_OK);
    EXPECT_EQ(infoOf(own, asset, 1).residentBytes, infoOf(own, asset, 1).segmentBytes);
    PlayedGroup streamed(own, playedGroup(asset, 2, 0)), whole(own, playedGroup(createStreamed(own, kPip, 0), 2, 0));
    for (PlayedGroup* const group : {&streamed, &whole}) {
        group->play(0, 1, 0.1);
        group->play(1, 1, 0.6);
        EXPECT_EQ(group->run(0.25), 0u);
    }
    EXPECT_EQ(streamed.poses, whole.poses);
}

TEST_F(StreamedClips, ComeByTheBudgetOfUploads) {
    const ValidationGuard guard;
    for (const VkDeviceSize budget : {VkDeviceSize{100}, VkDeviceSize{1000}, VkDeviceSize{4096}}) {
        CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW);
        const SuppleAsset asset = createStreamed(own, kPip, kWholePool);
        PlayedGroup streamed(own, playedGroup(asset, 1, 0));
        streamed.play(0, 0, 0.0);
        EXPECT_EQ(streamed.run(0.0), 0u);
        ASSERT_EQ(suppleSetUploadBudget(own.handle(), budget), SUPPLE_OK);
        const uint64_t wanted = infoOf(own, asset, 0).segmentBytes;
        EXPECT_EQ(request(own, asset, 0), SUPPLE_OK);
        uint64_t sum = 0, frames = 0;
        while (infoOf(own, asset, 0).residentBytes < wanted && frames < kMostAwaited) {
            ++frames;
            const bool looks = frames % 16 == 1; // comparing takes longest
            if (looks) {
                EXPECT_EQ(streamed.run(0.01 * static_cast<double>(frames)), 0u);
            } else {
                own.run(streamed.crowd.group());
            }
            EXPECT_LE(frameBytesOf(own), budget / 2);
            sum += frameBytesOf(own);
        }
        EXPECT_EQ(sum, wanted);
        EXPECT_GE(frames, wanted / (budget / 2));
        EXPECT_LE(frames, wanted / (budget / 2 / 4 * 4) + 2);
        EXPECT_EQ(streamed.run(3.0), 0u);
    }
}

TEST_F(StreamedClips, ShareAPoolThatIsTooSmall) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset probe = createStreamed(own, kWren, kWholePool);
    const uint64_t first = infoOf(own, probe, 0).segmentBytes, second = infoOf(own, probe, 1).segmentBytes;
    const uint64_t pool = std::max(first, second) + 64; // not for both
    const SuppleAsset asset = createStreamed(own, kWren, pool);
    PlayedGroup streamed(own, playedGroup(asset, 2, 0));
    streamed.play(0, 0, 0.0);
    streamed.play(1, 1, 0.0);
    const auto run = [&] {
        for (int frame = 0; frame < 3; ++frame) {
            EXPECT_EQ(streamed.run(0.1 * frame), 0u);
        }
    };
    run();
    EXPECT_EQ(request(own, asset, 0), SUPPLE_OK);
    run();
    EXPECT_EQ(infoOf(own, asset, 0).residentBytes, first);
    EXPECT_EQ(request(own, asset, 1), SUPPLE_OK);
    run();
    EXPECT_EQ(infoOf(own, asset, 1).residentBytes, second) << "what was asked for later takes the room";
    EXPECT_LT(infoOf(own, asset, 0).residentBytes, first);
    // What is pinned stays.
    EXPECT_EQ(request(own, asset, 0, SUPPLE_CLIP_PIN), SUPPLE_OK);
    run();
    EXPECT_EQ(request(own, asset, 1), SUPPLE_OK);
    run();
    EXPECT_EQ(infoOf(own, asset, 0).residentBytes, first);
    EXPECT_LT(infoOf(own, asset, 1).residentBytes, second);
    EXPECT_EQ(request(own, asset, 1, SUPPLE_CLIP_PIN), SUPPLE_ERROR_LIMIT);
    EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_LIMIT);
    // Released, it makes room for what still waits.
    EXPECT_EQ(request(own, asset, 0, SUPPLE_CLIP_RELEASE), SUPPLE_OK);
    run();
    EXPECT_EQ(infoOf(own, asset, 1).residentBytes, second);
}

TEST_F(StreamedClips, ComeByStretches) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = createStreamed(own, kPip, kWholePool);
    uint32_t longest = 0;
    for (uint32_t clip = 1; clip < 3; ++clip) {
        longest = infoOf(own, asset, clip).duration > infoOf(own, asset, longest).duration ? clip : longest;
    }
    const SuppleClipInfo info = infoOf(own, asset, longest);
    EXPECT_EQ(request(own, asset, longest, SUPPLE_CLIP_REQUEST, 0.0, 1e-3), SUPPLE_OK);
    const uint64_t begin = infoOf(own, asset, longest).residentBytes;
    EXPECT_GT(begin, 0u);
    EXPECT_LT(begin, info.segmentBytes);
    EXPECT_EQ(request(own, asset, longest, SUPPLE_CLIP_REQUEST, info.duration, 2.0 * info.duration), SUPPLE_OK);
    EXPECT_GT(infoOf(own, asset, longest).residentBytes, begin);
    EXPECT_EQ(request(own, asset, longest), SUPPLE_OK);
    EXPECT_EQ(infoOf(own, asset, longest).residentBytes, info.segmentBytes);
}

/// Whatever is asked for, in whatever order, with frames that are cancelled.
TEST_F(StreamedClips, HaveTheBitsOfTheCpuWhateverIsAskedFor) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext own(*testDevice(), mapping);
        const SuppleAsset probe = createStreamed(own, kWren, kWholePool);
        const uint32_t clips = 6;
        uint64_t all = 0;
        for (uint32_t clip = 0; clip < clips; ++clip) {
            all += infoOf(own, probe, clip).segmentBytes;
        }
        const SuppleAsset asset = createStreamed(own, kWren, all / 3);
        const uint32_t flags = SUPPLE_GROUP_TRANSITIONS | SUPPLE_GROUP_UPDATE_RATES;
        PlayedGroup streamed(own, playedGroup(asset, 4, flags));
        std::mt19937 random(11);
        double time = 0.0;
        uint64_t arrived = 0, left = 0, before = 0;
        for (uint32_t frame = 0; frame < 90; ++frame) {
            for (uint32_t i = 0; i < 4 && frame % 10 == 0; ++i) {
                SupplePlaybackDesc over{};
                over.transition = frame % 20 == 0 ? 0.1 : 0.0;
                over.updateInterval = i == 3 ? 4 : 1;
                streamed.play(i, static_cast<uint32_t>(random()) % clips, 0.1 * i, over);
            }
            if (frame == 30) {
                ASSERT_EQ(suppleSetUploadBudget(own.handle(), 3000), SUPPLE_OK);
            }
            const auto clip = static_cast<uint32_t>(random()) % clips;
            const double begin = 0.4 * static_cast<double>(random() % 4);
            const auto use = static_cast<SuppleClipUse>(random() % 8 == 0 ? 1 + random() % 2 : 0);
            const SuppleResult asked = request(own, asset, clip, use, begin, begin + 0.8);
            EXPECT_TRUE(asked == SUPPLE_OK || (asked == SUPPLE_ERROR_LIMIT && use == SUPPLE_CLIP_PIN));
            (void)own.takeError();
            if (random() % 5 == 0) {
                own.cancel(streamed.crowd.group());
            }
            time += 0.03;
            EXPECT_EQ(streamed.run(time), 0u) << mappingName(mapping) << ", frame " << frame;
            const uint64_t now = residentIn(own, asset, clips);
            EXPECT_LE(now, all / 3);
            arrived += now > before ? 1 : 0;
            left += now < before ? 1 : 0;
            before = now;
        }
        EXPECT_GT(arrived, 5u);
        EXPECT_GT(left, 2u);
    }
}

TEST_F(StreamedClips, StayThroughAnotherCapacityAndAreAskedForAnewByAReload) {
    const ValidationGuard guard;
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = createStreamed(own, kPip, kWholePool);
    PlayedGroup streamed(own, playedGroup(asset, 2, 0));
    streamed.play(0, 0, 0.0);
    streamed.play(1, 1, 0.0);
    EXPECT_EQ(streamed.run(0.0), 0u);
    EXPECT_EQ(request(own, asset, 0), SUPPLE_OK);
    EXPECT_EQ(streamed.run(0.1), 0u);
    EXPECT_EQ(streamed.run(0.2), 0u);
    const uint64_t there = infoOf(own, asset, 0).residentBytes;
    EXPECT_GT(there, 0u);
    ASSERT_EQ(suppleSetCapacity(own.handle(), streamed.crowd.group(), 9), SUPPLE_OK);
    EXPECT_EQ(infoOf(own, asset, 0).residentBytes, there);
    EXPECT_EQ(streamed.run(0.3), 0u);
    const SuppleAssetDesc anew = describe(kPip, kWholePool), whole = describe(kPip, 0);
    ASSERT_EQ(suppleReloadAsset(own.handle(), asset, &anew), SUPPLE_OK);
    EXPECT_EQ(infoOf(own, asset, 0).residentBytes, there) << "it comes with the new tables";
    EXPECT_EQ(infoOf(own, asset, 1).residentBytes, 0u);
    EXPECT_EQ(streamed.run(0.4), 0u);
    ASSERT_EQ(suppleReloadAsset(own.handle(), asset, &whole), SUPPLE_OK);
    EXPECT_EQ(infoOf(own, asset, 1).residentBytes, infoOf(own, asset, 1).segmentBytes);
    EXPECT_EQ(request(own, asset, 1), SUPPLE_OK) << "nothing to do";
    EXPECT_EQ(streamed.run(0.5), 0u);
}

TEST_F(StreamedClips, OutliveTheirGroupsAndTheAssetsHandle) {
    const ValidationGuard guard;
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = createStreamed(own, kPip, kWholePool);
    const uint64_t all = infoOf(own, asset, 0).segmentBytes;
    {
        PlayedGroup first(own, playedGroup(asset, 1, 0));
        first.play(0, 0, 0.0);
        EXPECT_EQ(first.run(0.0), 0u);
        EXPECT_EQ(request(own, asset, 0), SUPPLE_OK);
        own.beginFrame(); // its copies are recorded by nobody
        first.crowd.end();
    }
    for (int frame = 0; frame < 4; ++frame) {
        own.beginFrame();
    }
    EXPECT_EQ(infoOf(own, asset, 0).residentBytes, 0u);
    PlayedGroup second(own, playedGroup(asset, 1, 0));
    second.play(0, 0, 0.0);
    for (int frame = 0; frame < 3; ++frame) {
        EXPECT_EQ(second.run(0.1 * frame), 0u);
    }
    EXPECT_EQ(infoOf(own, asset, 0).residentBytes, all);
    EXPECT_EQ(request(own, asset, 1), SUPPLE_OK);
    ASSERT_EQ(suppleDestroyAsset(own.handle(), asset), SUPPLE_OK);
    second.play(0, 1, 0.0);
    EXPECT_EQ(second.run(0.1), 0u);
    const std::vector<float> twin = second.poses;
    EXPECT_EQ(second.run(0.2), 0u);
    EXPECT_EQ(second.run(0.1), 0u);
    EXPECT_NE(second.poses, twin) << "what was asked for has come all the same";
}

TEST_F(StreamedClips, AreRefusedWithReasons) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = createStreamed(own, kPip, 4096);
    EXPECT_EQ(request(own, asset, 3), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_OUT_OF_RANGE);
    EXPECT_EQ(request(own, asset, 0, static_cast<SuppleClipUse>(3)), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_OUT_OF_RANGE);
    for (const auto& [begin, end] : {std::pair(-1.0, 0.0), std::pair(0.5, 0.25), std::pair(0.0, -1.0)}) {
        EXPECT_EQ(request(own, asset, 0, SUPPLE_CLIP_REQUEST, begin, end), SUPPLE_ERROR_ARGUMENT);
        EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_OUT_OF_RANGE);
    }
    EXPECT_EQ(request(own, asset, 0, SUPPLE_CLIP_REQUEST, std::numeric_limits<double>::quiet_NaN()),
              SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_NOT_FINITE);
    EXPECT_EQ(request(own, SuppleAsset{77}, 0), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_STALE_HANDLE);
    SuppleAssetDesc asked = describe(kPip, 4096);
    SupplePrepareDesc prepare{};
    prepare.structSize = sizeof prepare;
    prepare.asset = &asked;
    SupplePrepared prepared = nullptr;
    EXPECT_EQ(supplePrepare(&prepare, &prepared), SUPPLE_ERROR_ARGUMENT) << "a pool is the context's";
    asked.clipPoolBytes = 0;
    prepare.coarseClipError = 1e-2f;
    EXPECT_EQ(supplePrepare(&prepare, &prepared), SUPPLE_ERROR_ARGUMENT) << "twins of clips that are not packed";
    prepare.clipError = 1e-2f;
    EXPECT_EQ(supplePrepare(&prepare, &prepared), SUPPLE_ERROR_ARGUMENT) << "not more than the clip's own";
    EXPECT_EQ(prepared, nullptr);
}

/// Memory of the device without streaming, and with a pool for a quarter of the segments.
TEST_F(StreamedClips, TakeLessMemory) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    for (const std::string& file : {kPip, kWren}) {
        uint64_t segments = 0;
        const auto tablesWith = [&](uint64_t pool) {
            const SuppleAsset asset = createStreamed(own, file, pool);
            PlayedGroup group(own, playedGroup(asset, 1, 0));
            const auto& clips = group.group().asset().clips;
            segments = 0;
            for (uint32_t clip = 0; clip < group.crowd.clipCount(); ++clip) {
                segments += infoOf(own, asset, clip).segmentBytes;
            }
            return clips.size(0);
        };
        const uint64_t whole = tablesWith(0), streamed = tablesWith(segments / 4);
        EXPECT_EQ(tablesWith(kWholePool), whole);
        EXPECT_NEAR(static_cast<double>(whole - streamed), 0.75 * static_cast<double>(segments), 32.0);
    }
}

TEST_F(StreamedClips, AreReplayed) {
    for (const bool late : {false, true}) {
        CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW, 2, late ? SUPPLE_CONTEXT_RECORDABLE : 0);
        Recorded recorded;
        if (!late) {
            ASSERT_EQ(recorded.start(own.handle()), SUPPLE_OK);
        }
        const SuppleAsset asset = createStreamed(own, kWren, 20000);
        EXPECT_EQ(request(own, asset, 2, SUPPLE_CLIP_PIN), SUPPLE_OK);
        PlayedGroup streamed(own, playedGroup(asset, 3, SUPPLE_GROUP_UPDATE_RATES));
        std::mt19937 random(5);
        for (uint32_t frame = 0; frame < 24; ++frame) {
            if (late && frame == 10) {
                own.beginFrame();
                ASSERT_EQ(recorded.start(own.handle()), SUPPLE_OK);
            }
            for (uint32_t i = 0; i < 3 && frame % 8 == 0; ++i) {
                SupplePlaybackDesc desc{};
                desc.updateInterval = i == 2 ? 2 : 1;
                streamed.play(i, static_cast<uint32_t>(random()) % 6, 0.1 * i, desc);
            }
            if (frame == 4) {
                EXPECT_EQ(suppleSetUploadBudget(own.handle(), late ? 0 : 4000), SUPPLE_OK);
            }
            if (frame % 2 == 1) {
                EXPECT_EQ(request(own, asset, static_cast<uint32_t>(random()) % 6, SUPPLE_CLIP_REQUEST, 0.0, 1.0),
                          SUPPLE_OK);
            }
            EXPECT_EQ(streamed.run(0.05 * frame), 0u);
        }
        own.beginFrame();
        SCOPED_TRACE(late);
        const ReadRecording read = expectReplayed(own.handle(), recorded, 28);
        EXPECT_TRUE(read.calls.contains(runtime::kCallNumber<runtime::calls::RequestClip>));
    }
}

SuppleResult recordUploads(CrowdContext& context, Commands& commands) {
    SuppleResult result = SUPPLE_OK;
    commands.record([&](VkCommandBuffer buffer) { result = suppleRecordUploads(context.handle(), buffer); });
    return result;
}
/// With two frames in flight.
void beginNext(CrowdContext& context) {
    ++context.frame;
    EXPECT_EQ(suppleBeginFrame(context.handle(), context.frame, context.frame - 2), SUPPLE_OK);
}

/// The host records uploads alone, and lets groups and the asset go while frames are in flight.
TEST_F(StreamedClips, GoUpWithTheHostsUploads) {
    const ValidationGuard guard;
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = createStreamed(own, kWren, kWholePool);
    Commands flights[2]{Commands(own.device()), Commands(own.device())};
    const auto fly = [&](const std::function<void()>& behind = {}) {
        Commands& commands = flights[own.frame % 2];
        commands.wait();
        beginNext(own);
        EXPECT_EQ(recordUploads(own, commands), SUPPLE_OK);
        commands.submit();
        if (behind) {
            behind();
        }
    };
    {
        PlayedGroup group(own, playedGroup(asset, 1, 0)), other(own, playedGroup(asset, 1, 0));
        group.play(0, 2, 0.0);
        other.play(0, 3, 0.1);
        EXPECT_EQ(group.run(0.0), 0u);
        own.beginFrame();
        ASSERT_EQ(suppleSetUploadBudget(own.handle(), 3000), SUPPLE_OK);
        EXPECT_EQ(request(own, asset, 2), SUPPLE_OK);
        for (uint32_t frame = 0; frame < 40; ++frame) {
            fly();
        }
        EXPECT_EQ(infoOf(own, asset, 2).residentBytes, infoOf(own, asset, 2).segmentBytes);
        for (Commands& commands : flights) {
            commands.wait();
        }
        EXPECT_EQ(group.run(0.1), 0u);
        EXPECT_EQ(other.run(0.1), 0u) << "another group of the asset";
        EXPECT_EQ(request(own, asset, 3), SUPPLE_OK);
        own.beginFrame();
        fly();
        fly([&] {
            group.crowd.end();
            other.crowd.end();
        });
    }
    EXPECT_EQ(request(own, asset, 4), SUPPLE_OK);
    fly(); // it has no groups
    EXPECT_EQ(frameBytesOf(own), 0u);
    fly([&] { EXPECT_EQ(suppleDestroyAsset(own.handle(), asset), SUPPLE_OK); });
    for (uint32_t frame = 0; frame < 4; ++frame) {
        fly();
    }
    for (Commands& commands : flights) {
        commands.wait();
    }
    own.beginFrame();
}

/// Groups, asset and segments go at once, and the frames before are in flight.
TEST_F(StreamedClips, AreLeftAloneBehindAReload) {
    const ValidationGuard guard;
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = createStreamed(own, kWren, kWholePool);
    PlayedGroup group(own, playedGroup(asset, 1, 0));
    group.play(0, 2, 0.0);
    EXPECT_EQ(group.run(0.0), 0u);
    Commands flights[2]{Commands(own.device()), Commands(own.device())};
    for (uint32_t frame = 0; frame < 8; ++frame) {
        EXPECT_EQ(request(own, asset, frame % 6, frame % 2 == 0 ? SUPPLE_CLIP_REQUEST : SUPPLE_CLIP_RELEASE),
                  SUPPLE_OK);
        Commands& commands = flights[own.frame % 2];
        commands.wait();
        beginNext(own);
        EXPECT_EQ(recordUploads(own, commands), SUPPLE_OK);
        commands.submit();
        if (frame == 4) {
            const SuppleAssetDesc anew = describe(kWren, kWholePool);
            ASSERT_EQ(suppleReloadAsset(own.handle(), asset, &anew), SUPPLE_OK);
        }
    }
    for (Commands& commands : flights) {
        commands.wait();
    }
    EXPECT_EQ(group.run(0.3), 0u);
}

/// Whatever the order in which assets were created.
TEST_F(StreamedClips, OfSeveralAssetsComeInTheOrderOfTheRequests) {
    const ValidationGuard guard;
    for (const bool firstComesFirst : {false, true}) {
        CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW);
        const SuppleAsset assets[2] = {createStreamed(own, kPip, kWholePool), createStreamed(own, kWren, kWholePool)};
        PlayedGroup pip(own, playedGroup(assets[0], 1, 0)), wren(own, playedGroup(assets[1], 1, 0));
        pip.play(0, 0, 0.0);
        wren.play(0, 0, 0.0);
        EXPECT_EQ(pip.run(0.0), 0u);
        EXPECT_EQ(wren.run(0.0), 0u);
        ASSERT_EQ(suppleSetUploadBudget(own.handle(), 1000), SUPPLE_OK);
        const SuppleAsset early = assets[firstComesFirst ? 0 : 1], late = assets[firstComesFirst ? 1 : 0];
        EXPECT_EQ(request(own, early, 0), SUPPLE_OK);
        EXPECT_EQ(request(own, late, 0), SUPPLE_OK);
        const uint64_t all = infoOf(own, early, 0).segmentBytes;
        const SuppleGroup groups[2] = {pip.crowd.group(), wren.crowd.group()};
        uint64_t before = 0, frames = 0;
        while (infoOf(own, early, 0).residentBytes < all && frames < kMostAwaited) {
            before = infoOf(own, late, 0).residentBytes;
            own.run(groups);
            EXPECT_LE(frameBytesOf(own), 500u);
            ++frames;
        }
        EXPECT_EQ(before, 0u);
        for (; infoOf(own, late, 0).residentBytes < infoOf(own, late, 0).segmentBytes && frames < kMostAwaited;
             ++frames) {
            own.run(groups);
        }
        EXPECT_LT(frames, kMostAwaited);
        EXPECT_EQ(pip.run(0.2), 0u);
        EXPECT_EQ(wren.run(0.2), 0u);
    }
}

/// Poses of update rates stay if other clips change.
TEST_F(StreamedClips, MakeOnlyThosePosesAnewThatPlayThem) {
    const ValidationGuard guard;
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = createStreamed(own, kPip, kWholePool);
    PlayedGroup group(own, playedGroup(asset, 2, SUPPLE_GROUP_UPDATE_RATES));
    for (uint32_t i = 0; i < 2; ++i) {
        SupplePlaybackDesc desc{};
        desc.updateInterval = 8;
        group.play(i, i, 0.3, desc);
    }
    const auto posesOfFrame = [&] {
        EXPECT_EQ(group.run(0.01), 0u);
        return group.group().poses().playback()->poseCount(group.group().windows());
    };
    EXPECT_EQ(posesOfFrame(), 4u);
    EXPECT_EQ(posesOfFrame(), 0u);
    for (const uint32_t clip : {2u, 1u, 0u}) {
        EXPECT_EQ(request(own, asset, clip), SUPPLE_OK);
        EXPECT_EQ(posesOfFrame(), 0u) << "it is on its way";
        EXPECT_EQ(posesOfFrame(), clip < 2 ? 2u : 0u) << clip;
        EXPECT_EQ(posesOfFrame(), 0u);
    }
}

/// In a frame that the host then cancels, a recording begins, and what it has let go is on the device in the next.
TEST_F(StreamedClips, AreReplayedFromAFrameThatIsCancelled) {
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW, 2, SUPPLE_CONTEXT_RECORDABLE);
    const SuppleAsset asset = createStreamed(own, kWren, kWholePool);
    PlayedGroup group(own, playedGroup(asset, 1, 0));
    group.play(0, 1, 0.0);
    EXPECT_EQ(group.run(0.0), 0u);
    EXPECT_EQ(request(own, asset, 1), SUPPLE_OK);
    EXPECT_EQ(group.run(0.1), 0u);
    EXPECT_EQ(group.run(0.2), 0u);
    EXPECT_GT(infoOf(own, asset, 1).residentBytes, 0u);
    own.beginFrame();
    Commands dropped(own.device());
    EXPECT_EQ(recordUploads(own, dropped), SUPPLE_OK);
    Recorded recorded;
    ASSERT_EQ(recorded.start(own.handle()), SUPPLE_OK);
    EXPECT_EQ(infoOf(own, asset, 1).residentBytes, 0u);
    EXPECT_EQ(suppleCancelFrame(own.handle()), SUPPLE_OK);
    for (uint32_t frame = 0; frame < 5; ++frame) {
        EXPECT_EQ(group.run(0.2 + 0.1 * frame), 0u);
    }
    EXPECT_EQ(infoOf(own, asset, 1).residentBytes, infoOf(own, asset, 1).segmentBytes);
    own.beginFrame();
    expectReplayed(own.handle(), recorded, 10);
}

/// A recording that cannot begin changes nothing.
TEST_F(StreamedClips, StayIfARecordingIsRefused) {
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW, 2, SUPPLE_CONTEXT_RECORDABLE);
    const SuppleAsset asset = createStreamed(own, kPip, kWholePool);
    PlayedGroup group(own, playedGroup(asset, 1, 0));
    group.play(0, 0, 0.0);
    EXPECT_EQ(request(own, asset, 0), SUPPLE_OK);
    for (const double time : {0.0, 0.1, 0.2}) {
        EXPECT_EQ(group.run(time), 0u);
    }
    const uint64_t there = infoOf(own, asset, 0).residentBytes;
    EXPECT_EQ(there, infoOf(own, asset, 0).segmentBytes);
    own.beginFrame();
    SuppleRecordingDesc desc{};
    desc.structSize = sizeof desc;
    desc.write = [](const void*, size_t, void*) { return 0; };
    EXPECT_EQ(suppleStartRecording(own.handle(), &desc), SUPPLE_ERROR_ARGUMENT);
    (void)own.takeError();
    EXPECT_EQ(infoOf(own, asset, 0).residentBytes, there);
    EXPECT_EQ(group.run(0.3), 0u);
}

} // namespace
} // namespace supple::test
