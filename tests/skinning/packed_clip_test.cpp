// Packed clips: words that are written are read, whoever spoils them is refused, and what is packed keeps within its
// error.
#include "shaders/shared/pose.h"
#include "skinning/clip_packer.h"
#include "skinning/clip_table.h"
#include "skinning/coarse_clip.h"
#include "skinning/packed_clip.h"
#include "skinning/playback.h"
#include "skinning/pose.h"
#include "skinning/pose_twin.h"
#include "skinning/root_motion.h"
#include "tests/support/read_character.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sample_assets.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace supple::skinning {
namespace {

using cage::ChannelPath;
using test::channel;
using test::clipOf;

double extentOf(const cage::Character& character) {
    Pose rest;
    restPose(character, rest);
    glm::dvec3 low(1e30), high(-1e30);
    for (const glm::dvec3& p : deformOnCpu(character, rest)) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return glm::length(high - low);
}

/// The largest distance between two clips of one character, of vertices and joints, in extents.
double distance(const cage::Character& character, const cage::Clip& a, const cage::Clip& b, int times) {
    Pose one, other;
    double worst = 0.0;
    for (int k = 0; k <= times; ++k) {
        const double time = a.duration * (k < times ? std::fmod(0.618034 * k, 1.0) : 1.0);
        sampleClip(character, a, time, one);
        sampleClip(character, b, time, other);
        const std::vector<glm::dvec3> p = deformOnCpu(character, one), q = deformOnCpu(character, other);
        for (size_t v = 0; v < p.size(); ++v) {
            worst = std::max(worst, glm::length(p[v] - q[v]));
        }
    }
    return worst / extentOf(character);
}

PackedClip randomClip(std::mt19937& random, const PackedPlaces& places) {
    const auto below = [&](uint32_t n) { return std::uniform_int_distribution<uint32_t>(0, n - 1)(random); };
    PackedClip clip;
    clip.last = 1 + below(100);
    for (uint32_t place = 0; place < places.count(); ++place) {
        const bool isNode = place < places.nodes;
        for (uint32_t path = 0; path < (isNode ? 3 : 1); ++path) {
            if (below(3) == 0) {
                continue;
            }
            PackedProperty& own = clip.properties.emplace_back();
            own.place = place;
            own.path = isNode ? static_cast<ChannelPath>(path) : ChannelPath::weights;
            own.isConstant = below(3) == 0;
            const auto number = [&] { return static_cast<int>(below(1u << (1 + below(20)))) - (1 << below(19)); };
            const auto value = [&] {
                return glm::clamp(glm::ivec3(number(), number(), number()), glm::ivec3(-524287), glm::ivec3(524287));
            };
            if (own.isConstant) {
                own.exponent = 27 - 2 * static_cast<int>(below(16));
                own.values = {value()};
                continue;
            }
            const bool isTurn = own.path == ChannelPath::rotation;
            own.exponent = static_cast<int>(below(29)) - 8;
            own.reference = isTurn ? std::array{below(31), below(31), below(31)} : PackedProperty().reference;
            const glm::ivec3 base = value();
            const uint32_t width = 1u << below(16); // three knots fit into two elements
            for (uint32_t f = 0; f <= clip.last; ++f) {
                if (f % shared::kSegmentFrames == 0 || f == clip.last || below(3) == 0) {
                    own.frames.push_back(f);
                    const glm::ivec3 step(static_cast<int>(below(width)), static_cast<int>(below(width)), 0);
                    own.values.push_back(glm::clamp(base + step, glm::ivec3(-524287), glm::ivec3(524287)));
                }
            }
            removeEqualKnots(own);
        }
    }
    return clip;
}

bool same(const PackedClip& a, const PackedClip& b) {
    return a.last == b.last && std::equal(a.properties.begin(), a.properties.end(), b.properties.begin(),
                                          b.properties.end(), [](const PackedProperty& p, const PackedProperty& q) {
                                              return p.place == q.place && p.path == q.path &&
                                                     p.isConstant == q.isConstant && p.exponent == q.exponent &&
                                                     p.reference == q.reference && p.frames == q.frames &&
                                                     p.values == q.values;
                                          });
}

TEST(PackedClips, WordsThatAreWrittenAreRead) {
    std::mt19937 random(7);
    for (int i = 0; i < 200; ++i) {
        const PackedPlaces places{1 + static_cast<size_t>(i) % 40, static_cast<size_t>(i) % 7};
        const PackedClip clip = randomClip(random, places);
        const double duration = 0.1 + 0.05 * i;
        const std::optional<std::vector<uint32_t>> words = packedWords(clip, duration, places);
        ASSERT_TRUE(words.has_value()) << i;
        const Result<PackedClip> again = readPackedWords(*words, duration, places);
        ASSERT_TRUE(again.ok()) << i << ": " << again.error().message;
        EXPECT_TRUE(same(clip, *again)) << i;
    }
}

TEST(PackedClips, WordsThatAreSpoiledAreRefusedOrMeanSomething) {
    std::mt19937 random(8);
    size_t refused = 0, taken = 0;
    for (int i = 0; i < 400; ++i) {
        const PackedPlaces places{1 + static_cast<size_t>(i) % 20, static_cast<size_t>(i) % 7};
        const PackedClip clip = randomClip(random, places);
        std::vector<uint32_t> words = *packedWords(clip, 1.0, places);
        for (int k = 0; k < 20; ++k) {
            std::vector<uint32_t> spoiled = words;
            spoiled[random() % spoiled.size()] ^= 1u << random() % 32;
            if (k == 0) {
                spoiled.resize(random() % spoiled.size());
            }
            const Result<PackedClip> found = readPackedWords(spoiled, 1.0, places);
            (found ? taken : refused)++;
            if (found) { // its numbers are others: they are written as they were found
                const std::optional<std::vector<uint32_t>> rewritten = packedWords(*found, 1.0, places);
                EXPECT_TRUE(!rewritten || rewritten->size() <= spoiled.size());
                const std::vector<uint32_t> joints(places.nodes, 0u);
                for (const cage::Channel& own : channelsOf(*found, 1.0, joints, places.targets)) {
                    EXPECT_TRUE(std::is_sorted(own.times.begin(), own.times.end()));
                    EXPECT_TRUE(
                        std::all_of(own.values.begin(), own.values.end(), [](float x) { return std::isfinite(x); }));
                }
            }
        }
        EXPECT_FALSE(readPackedWords(words, 2.0, places).ok()) << "its rate follows from the duration";
        EXPECT_FALSE(readPackedWords(words, 1.0, {places.nodes + 16, places.targets}).ok());
    }
    EXPECT_GT(refused, 1000u);
    EXPECT_GT(taken, 1000u);
}

TEST(PackedClips, CountsThatOverflowAreRefused) {
    // 65,541 properties that change, and one constant: as halves of a word these look like 5 and 1.
    constexpr uint32_t kNodes = 22'000, kChanging = 65'541;
    PackedClip clip;
    for (uint32_t place = 0; place < 5; ++place) {
        PackedProperty& own = clip.properties.emplace_back();
        own.place = place;
        own.frames = {0, 1};
        own.values = {glm::ivec3(0), glm::ivec3(1)};
    }
    PackedProperty& still = clip.properties.emplace_back();
    still.place = kNodes - 1;
    still.isConstant = true;
    still.exponent = 27;
    still.values = {glm::ivec3(0)};
    std::vector<uint32_t> words = *packedWords(clip, 1.0, {kNodes});
    ASSERT_TRUE(readPackedWords(words, 1.0, {kNodes}).ok());
    uint32_t changing = 0;
    for (size_t element = words[4]; element < words[5]; ++element) {
        uint32_t* const masks = &words[4 * element];
        masks[3] = changing;
        for (const auto& [word, bits] : {std::pair(0, 32u), std::pair(1, 16u)}) {
            const bool last = element + 1 == words[5];
            const uint32_t count = last ? 0 : std::min(bits, kChanging - changing);
            const uint32_t kept = masks[word] & (word == 1 ? 0xFFFF0000u : 0u);
            masks[word] = kept | (count == 32 ? 0xFFFFFFFFu : (1u << count) - 1u);
            changing += count;
        }
    }
    ASSERT_EQ(changing, kChanging);
    EXPECT_FALSE(readPackedWords(words, 1.0, {kNodes}).ok());
}

TEST(PackedClips, ThatStandAtTheEndAreReadWithinTheTable) {
    // Its last segment has no bits, and nothing follows the clip in the table.
    cage::Character tube = test::riggedTube({.segments = 4, .sides = 4, .joints = 2});
    std::vector<float> times, turns;
    for (int k = 0; k <= 40; ++k) {
        times.push_back(static_cast<float>(k) / 30.0f);
        // So little that the lowest number of each segment is kept as it is.
        const float angle = k < 20 ? 0.006f * std::sin(0.7f * static_cast<float>(k)) : 0.003f;
        turns.insert(turns.end(), {0.0f, std::sin(angle), 0.0f, std::cos(angle)});
    }
    tube.clips.push_back(clipOf({channel(2, ChannelPath::rotation, times, turns)}));
    ASSERT_TRUE(packClips(tube, 1e-3).empty());
    ASSERT_FALSE(tube.clips[0].packed.words.empty());
    const ClipTable table = buildClipTable(tube);
    EXPECT_EQ(table.footCount, 0u);
    // The last segment's data begins where only padding is left, and the padding is read as two elements.
    const std::vector<uint32_t>& packed = tube.clips[0].packed.words;
    const size_t lastSegment = packed[6] + packed[3] - 1;
    EXPECT_EQ(packed[4 * lastSegment + 1], packed.size() / 4 - 2);
    EXPECT_EQ(table.words.size() / 4, table.contacts) << "nothing else is behind it";
    const PoseLayout layout = PoseLayout::of(SkinningMode::linear, table.jointCount, 0);
    PoseTwin twin(table, layout, 0);
    std::vector<uint32_t> words(4 * size_t{PlaybackState::elements(0)});
    PlaybackState state(words);
    state.setTransform(glm::mat4(1.0f));
    PlaybackLayer layer;
    PlaybackDesc desc;
    desc.layers = {&layer, 1};
    state.set(tube, table, desc);
    std::vector<float> masks(4 * size_t{maskElements(table)} * shared::kMaxMasks, 1.0f);
    Pose pose;
    for (const double time : {1.1, 1.3, 1.34, 2.0}) {
        twin.sample(words, masks, time);
        sampleClip(tube, tube.clips[0], time, pose);
        const glm::dquat& q = pose.locals[2].rotation;
        const glm::vec4 own = twin.locals()[table.places[2]].rotation;
        EXPECT_LT(glm::length(own - glm::vec4(glm::dvec4(q.x, q.y, q.z, q.w))), 2e-6f) << time;
    }
}

TEST(PackedClips, KeepTheRootThatTheClipsHad) {
    // The topmost node trembles by less than anybody sees.
    cage::Character wren = test::readCharacter(test::kWren);
    for (cage::Clip& clip : wren.clips) {
        const auto end = static_cast<float>(clip.duration);
        clip.channels.push_back(channel(0, ChannelPath::translation, {0, end}, {0, 0, 0, 1e-7f, 0, 0}));
    }
    const uint32_t root = findRoot(wren);
    EXPECT_EQ(root, 0u);
    (void)packClips(wren, 1e-4);
    EXPECT_EQ(findRoot(wren), root);
    wren.clipRoot = cage::kNone;
    EXPECT_NE(findRoot(wren), root) << "the channels that told are gone";
}

TEST(PackedClips, TellWhatTheyLeaveOut) {
    cage::Character tube = test::riggedTube({.segments = 4, .sides = 4, .joints = 2});
    std::vector<float> times, turns;
    for (int k = 0; k < 300; ++k) {
        times.push_back(static_cast<float>(k));
        turns.insert(turns.end(), {0.0f, 0.6f, 0.0f, 0.8f + 0.001f * static_cast<float>(k % 7)});
    }
    tube.clips.push_back(clipOf({channel(2, ChannelPath::rotation, times, turns)}));
    tube.clips.back().name = "long";
    const std::vector<std::string> leftOut = packClips(tube, 1e-4);
    ASSERT_EQ(leftOut.size(), 1u);
    EXPECT_EQ(leftOut[0], "clip \"long\" is not packed: it has too many frames");
    EXPECT_TRUE(tube.clips[0].packed.words.empty());
}

TEST(PackedClips, NumbersThatAreTooLargeAreNotWritten) {
    PackedClip clip;
    PackedProperty& own = clip.properties.emplace_back();
    own.frames = {0, 1};
    own.values = {glm::ivec3(0), glm::ivec3(1 << 19, 0, 0)};
    EXPECT_FALSE(packedWords(clip, 1.0, {1}).has_value());
    own.values[1].x = (1 << 19) - 1;
    EXPECT_TRUE(packedWords(clip, 1.0, {1}).has_value());
    // An inner knot and its neighbors lie in two elements: 2 * 45 bits of these and 3 * 13 of what it is off the line.
    const auto fits = [&](int off) {
        own.frames = {0, 16, 32};
        own.values = {glm::ivec3(0), glm::ivec3(16384 + off), glm::ivec3(32767)};
        clip.last = 32;
        return packedWords(clip, 1.0, {1}).has_value();
    };
    EXPECT_TRUE(fits(4095));
    EXPECT_FALSE(fits(4096));
}

TEST(PackedClips, KeepWithinTheErrorAndAreSmaller) {
    struct Case {
        std::string file;
        double ratio;
    };
    for (const Case& own : {Case{test::kPip, 8.5}, Case{test::kWren, 8.0}}) {
        const cage::Character plain = test::readCharacter(own.file);
        const NodeOrder order = nodeOrder(plain);
        double bytes = 0.0, before = 0.0;
        for (const double error : {1e-4, 1e-3}) {
            cage::Character packed = plain;
            (void)packClips(packed, error);
            ASSERT_EQ(packed.clips.size(), plain.clips.size());
            for (size_t c = 0; c < plain.clips.size(); ++c) {
                const cage::Clip& clip = packed.clips[c];
                ASSERT_FALSE(clip.packed.words.empty()) << own.file << " " << clip.name;
                EXPECT_EQ(clip.name, plain.clips[c].name);
                EXPECT_EQ(clip.duration, plain.clips[c].duration);
                EXPECT_EQ(clip.markers.size(), plain.clips[c].markers.size());
                EXPECT_LE(clip.packed.error, error);
                EXPECT_GT(clip.packed.error, 0.3 * error) << "it takes what it is given";
                EXPECT_LE(distance(plain, plain.clips[c], clip, 40), 1.1 * error) << clip.name;
                EXPECT_EQ(clip.packed.unpackedBytes, clipBytes(order, plain.clips[c]));
                if (error < 5e-4) {
                    bytes += static_cast<double>(clipBytes(order, clip));
                    before += static_cast<double>(clip.packed.unpackedBytes);
                }
                // Packed once more, it stays.
                cage::Character again = packed;
                (void)packClips(again, error);
                EXPECT_EQ(again.clips[c].packed.words, clip.packed.words);
            }
        }
        EXPECT_GT(before / bytes, own.ratio) << own.file;
    }
}

TEST(PackedClips, HaveCoarseTwins) {
    for (const std::string& file : {test::kPip, test::kWren}) {
        const cage::Character plain = test::readCharacter(file);
        const NodeOrder order = nodeOrder(plain);
        cage::Character packed = plain, alone = plain;
        (void)packClips(packed, 1e-4, 1e-2);
        (void)packClips(alone, 1e-4);
        double segments = 0.0, twins = 0.0;
        for (size_t c = 0; c < plain.clips.size(); ++c) {
            const cage::PackedChannels& own = packed.clips[c].packed;
            ASSERT_FALSE(own.coarseWords.empty()) << file << " " << plain.clips[c].name;
            EXPECT_EQ(own.words, alone.clips[c].packed.words) << "the clip is as it is without a twin";
            EXPECT_TRUE(alone.clips[c].packed.coarseWords.empty());
            EXPECT_TRUE(areTwins(own.words, own.coarseWords));
            EXPECT_LE(own.coarseError, 1e-2);
            EXPECT_GT(own.coarseError, 0.3e-2) << "it takes what it is given";
            const std::optional<cage::Clip> twin = coarseClip(order, packed.clips[c]);
            ASSERT_TRUE(twin.has_value());
            EXPECT_LE(distance(plain, plain.clips[c], *twin, 40), 1.1e-2) << plain.clips[c].name;
            EXPECT_FALSE(coarseClip(order, alone.clips[c]).has_value());
            segments += static_cast<double>(segmentWords(own.words));
            twins += static_cast<double>(own.coarseWords.size());
        }
        EXPECT_LT(twins / segments, 0.7) << file;
    }
}

/// A twin is beside a clip: whether it is worth it says nothing of the clip.
TEST(PackedClips, StayPackedWithoutATwin) {
    cage::Character packed = test::readCharacter(test::kPip);
    (void)packClips(packed, 1e-4);
    cage::Character close = test::readCharacter(test::kPip), again = packed;
    const std::vector<std::string> told = packClips(close, 1e-4, 1.001e-4), toldAgain = packClips(again, 1e-4, 1e-2);
    uint32_t without = 0;
    for (size_t c = 0; c < packed.clips.size(); ++c) {
        EXPECT_EQ(close.clips[c].packed.words, packed.clips[c].packed.words);
        without += close.clips[c].packed.coarseWords.empty() ? 1 : 0;
        EXPECT_EQ(toldAgain.at(c), "clip \"" + packed.clips[c].name + "\" has no coarse twin: it is packed already");
    }
    EXPECT_EQ(without, packed.clips.size());
    ASSERT_EQ(told.size(), without);
    EXPECT_EQ(told[0],
              "clip \"" + packed.clips[0].name + "\" has no coarse twin: it would take as much as the segments");
}

TEST(PackedClips, HaveTheirSegmentsBehindAllElse) {
    cage::Character packed = test::readCharacter(test::kPip);
    (void)packClips(packed, 1e-4, 1e-2);
    const ClipTable table = buildClipTable(packed);
    ASSERT_EQ(table.streamedClips.size(), packed.clips.size());
    uint32_t end = table.segments;
    for (const StreamedClip& clip : table.streamedClips) {
        const std::vector<uint32_t>& words = packed.clips[clip.clip].packed.words;
        const std::vector<SegmentPlaces> places = segmentsIn(words);
        ASSERT_EQ(clip.segmentCount, places.size());
        for (uint32_t s = 0; s < clip.segmentCount; ++s) {
            const StreamedSegment& segment = table.streamedSegments[clip.firstSegment + s];
            EXPECT_EQ(segment.records, end);
            EXPECT_LT(segment.element, table.segments);
            const uint32_t* const element = &table.words[4 * size_t{segment.element}];
            EXPECT_EQ(element[0], segment.records);
            EXPECT_EQ(element[1], segment.data);
            EXPECT_EQ(element[3], 0u) << "it is there";
            const auto same = [&](uint32_t to, uint32_t from, uint32_t count) {
                return std::equal(table.words.begin() + 4 * ptrdiff_t{to},
                                  table.words.begin() + 4 * ptrdiff_t{to + count}, words.begin() + 4 * ptrdiff_t{from});
            };
            EXPECT_TRUE(same(segment.records, places[s].records, segment.data - segment.records));
            EXPECT_TRUE(same(segment.data, places[s].data, segment.end - segment.data));
            end = segment.end;
        }
    }
    EXPECT_EQ(4 * size_t{end + kPackedPadding}, table.words.size());
}

/// A tube that bends, stretches and blinks, on no frames of a common rate.
cage::Character oddTube() {
    cage::Character tube = test::riggedTube({.segments = 6, .sides = 6, .joints = 4, .morphTargets = 3});
    std::vector<float> times, turns, ways, weights;
    for (int k = 0; k < 60; ++k) {
        const float t = 0.0213f * static_cast<float>(k);
        times.push_back(t);
        const float angle = 0.4f * std::sin(3.0f * t);
        turns.insert(turns.end(), {0.0f, std::sin(angle), 0.0f, std::cos(angle)});
        ways.insert(ways.end(), {0.3f * t, 0.1f * std::cos(5.0f * t), 0.0f});
        weights.insert(weights.end(), {0.5f * t, 0.0f, 0.25f});
    }
    cage::Channel blink = channel(1, ChannelPath::weights, times, weights);
    const cage::Channel steps =
        channel(3, ChannelPath::translation, {0, 0.5f, 1}, {2, 0, 0, 2, 1, 0, 2, 0, 0}, cage::Interpolation::step);
    const cage::Channel curve =
        channel(4, ChannelPath::scale, {0, 1}, {0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 1, 0, 2, 1, 1, 0, 0, 0},
                cage::Interpolation::cubicSpline);
    tube.clips.push_back(
        clipOf({channel(2, ChannelPath::rotation, times, turns), channel(1, ChannelPath::translation, times, ways),
                blink, steps, curve, channel(3, ChannelPath::rotation, {0, 1}, {0, 0, 0.6f, 0.8f, 0, 0, 0.6f, 0.8f}),
                channel(4, ChannelPath::rotation, {0, 1}, {0, 0, 0, 1, 0, 0, 0, 1})}));
    tube.clips.back().name = "odd";
    return tube;
}

TEST(PackedClips, LeaveAloneWhatTheyCannotPack) {
    const cage::Character plain = oddTube();
    cage::Character packed = plain;
    (void)packClips(packed, 1e-3);
    const cage::Clip& clip = packed.clips.front();
    ASSERT_FALSE(clip.packed.words.empty());
    EXPECT_LE(distance(plain, plain.clips.front(), clip, 100), 1.1e-3);
    const auto find = [&](const cage::Clip& of, uint32_t node, ChannelPath path) -> const cage::Channel* {
        const auto found = std::find_if(of.channels.begin(), of.channels.end(),
                                        [&](const cage::Channel& own) { return own.node == node && own.path == path; });
        return found != of.channels.end() ? &*found : nullptr;
    };
    for (const auto& [node, path] : {std::pair(3u, ChannelPath::translation), std::pair(4u, ChannelPath::scale)}) {
        const cage::Channel *before = find(plain.clips.front(), node, path), *after = find(clip, node, path);
        ASSERT_NE(after, nullptr);
        EXPECT_EQ(after->values, before->values);
        EXPECT_EQ(after->interpolation, before->interpolation);
    }
    EXPECT_EQ(find(clip, 4, ChannelPath::rotation), nullptr) << "it is at rest";
    EXPECT_EQ(find(clip, 3, ChannelPath::rotation)->times.size(), 1u) << "it is constant";
    const cage::Channel* const weights = find(clip, 0, ChannelPath::weights);
    ASSERT_NE(weights, nullptr);
    EXPECT_LT(weights->times.size(), 10u) << "they are straight";
    EXPECT_LT(weights - clip.channels.data(), clip.packed.channelCount);
    // If not all of them can be packed, none is.
    cage::Character stepped = plain;
    stepped.clips.front().channels[2].interpolation = cage::Interpolation::step;
    (void)packClips(stepped, 1e-3);
    ASSERT_FALSE(stepped.clips.front().packed.words.empty());
    EXPECT_EQ(find(stepped.clips.front(), 1, ChannelPath::weights)->values, plain.clips.front().channels[2].values);
    // Clips of one pose, and of no channels, stay.
    cage::Character still = plain;
    still.clips = {clipOf({channel(2, ChannelPath::rotation, {0}, {0, 0, 0.6f, 0.8f})}), cage::Clip()};
    (void)packClips(still, 1e-3);
    EXPECT_TRUE(still.clips[0].packed.words.empty() && still.clips[1].packed.words.empty());
    // So do long ones, in no time.
    cage::Character slow = plain;
    slow.clips = {clipOf({channel(2, ChannelPath::rotation, {0, 1e6f}, {0, 0, 0, 1, 0, 0, 0.6f, 0.8f})})};
    (void)packClips(slow, 1e-3);
    EXPECT_TRUE(slow.clips[0].packed.words.empty());
}

TEST(PackedClips, AreSampledByTheDevicesCodeAsByTheCpu) {
    for (cage::Character character : {test::readCharacter(test::kPip), test::readCharacter(test::kWren), oddTube()}) {
        (void)packClips(character, 1e-4);
        const ClipTable table = buildClipTable(character);
        const PoseLayout layout = PoseLayout::of(SkinningMode::linear, table.jointCount, table.targetCount);
        PoseTwin twin(table, layout, 0);
        std::vector<uint32_t> words(4 * size_t{PlaybackState::elements(layout.morphCount)});
        PlaybackState state(words);
        state.setTransform(glm::mat4(1.0f));
        std::vector<float> masks(4 * size_t{maskElements(table)} * shared::kMaxMasks, 1.0f);
        Pose pose;
        std::vector<glm::mat4> nodes(character.skeleton.nodes.size());
        const double extent = extentOf(character);
        for (uint32_t c = 0; c < character.clips.size(); ++c) {
            PlaybackLayer layer;
            layer.clip = c;
            PlaybackDesc desc;
            desc.layers = {&layer, 1};
            state.set(character, table, desc);
            const double duration = character.clips[c].duration;
            std::vector<double> times = {-1.0, 0.0, duration, duration + 1.0};
            for (int k = 0; k < 60; ++k) {
                times.push_back(duration * k / 60.0); // frames, borders of segments, and between
                times.push_back(std::nextafter(static_cast<float>(duration * k / 60.0), 0.0f));
            }
            for (const double time : times) {
                twin.pose(words, masks, time);
                sampleClip(character, character.clips[c], time, pose);
                localMatrices(character.skeleton, pose, nodes);
                globalTransforms(character.skeleton, nodes, nodes);
                double worst = 0.0;
                for (uint32_t j = 0; j < table.jointCount; ++j) {
                    const glm::mat4 d = twin.joint(j) - nodes[character.skin.joints[j]];
                    for (int column = 0; column < 4; ++column) {
                        worst =
                            std::max(worst, static_cast<double>(glm::length(d[column])) / (column == 3 ? extent : 1.0));
                    }
                }
                EXPECT_LT(worst, 2e-5) << character.clips[c].name << " at " << time;
                for (uint32_t t = 0; t < layout.morphCount; ++t) {
                    EXPECT_NEAR(twin.weights()[t / 4][static_cast<int>(t % 4)], pose.morphWeights[t], 2e-5);
                }
            }
        }
    }
}

} // namespace
} // namespace supple::skinning
