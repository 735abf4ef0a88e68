// Transitions: instances go over from what they have shown to what they play, without a jump of place or speed, as a
// function of the group's time, with the bits that the CPU has.
#include "tests/support/played_group.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sample_assets.h"
#include "tests/support/skinnings.h"

#include <algorithm>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

class Transitions : public CrowdContexts {};

constexpr double kSeconds = 0.3;
constexpr SuppleTransitionKind kKinds[] = {SUPPLE_TRANSITION_DEAD_BLENDING, SUPPLE_TRANSITION_QUINTIC};

const char* nameOf(SuppleTransitionKind kind) {
    return kind == SUPPLE_TRANSITION_QUINTIC ? "quintic" : "dead blending";
}

SupplePlaybackDesc goingOver(SuppleTransitionKind kind, double seconds = kSeconds, uint32_t flags = 0) {
    SupplePlaybackDesc desc{};
    desc.transition = seconds;
    desc.transitionKind = kind;
    desc.flags = flags;
    return desc;
}

SuppleGroupDesc transitingGroup(SuppleAsset asset, uint32_t capacity, SuppleSkinning skinning = SUPPLE_SKINNING_LINEAR,
                                uint32_t flags = 0) {
    return playedGroup(asset, capacity, SUPPLE_GROUP_TRANSITIONS | flags, skinning);
}

using Places = std::vector<glm::dvec3>;

/// Where the joints are at a time, by the CPU.
Places placesAt(const PlayedGroup& stage, uint32_t i, double time) {
    EXPECT_EQ(suppleSetTime(stage.handle(), stage.crowd.group(), time), SUPPLE_OK);
    Places places;
    for (uint32_t j = 0; j < stage.character().skin.joints.size(); ++j) {
        places.push_back(stage.placeOf(i, j));
    }
    return places;
}
double apart(const Places& a, const Places& b) {
    double most = 0.0;
    for (size_t j = 0; j < a.size(); ++j) {
        most = std::max(most, glm::length(a[j] - b[j]));
    }
    return most;
}
Places speeds(const Places& a, const Places& b, double seconds) {
    Places speed;
    for (size_t j = 0; j < a.size(); ++j) {
        speed.push_back((b[j] - a[j]) / seconds);
    }
    return speed;
}

/// What an instance does about a time at which `change` is called: how far joints jump, and by how much their speeds.
struct Jump {
    double place = 0.0, speed = 0.0;
};
template <class Change>
Jump jumpAt(const PlayedGroup& stage, uint32_t i, double time, Change&& change) {
    constexpr double kStep = 1.0 / 240.0;
    const Places before = placesAt(stage, i, time - kStep), there = placesAt(stage, i, time);
    change();
    const Places now = placesAt(stage, i, time), after = placesAt(stage, i, time + kStep);
    return {apart(there, now), apart(speeds(before, there, kStep), speeds(now, after, kStep))};
}

TEST_F(Transitions, BeginAsWhatWasShownMovesAndEndAsWhatIsPlayed) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        for (const std::string& file : {kPip, kWren}) {
            for (const SuppleSkinning skinning : kSkinnings) {
                // One of each kind, one that changes at once, one that has played the new clip all the time, and one
                // that plays both for a while.
                PlayedGroup stage(own, transitingGroup(own.asset(file), 5, skinning));
                ASSERT_TRUE(stage.crowd.valid());
                const double extent = stage.extent(), start = 2.3;
                for (uint32_t i = 0; i < 3; ++i) {
                    stage.play(i, 1, 0.2);
                }
                stage.play(3, 2, 0.1);
                stage.play(4, 1, 0.2);
                EXPECT_EQ(stage.run(start), 0u);
                SupplePlaybackLayer both[] = {PlayedGroup::loops(1, 0.2), PlayedGroup::loops(2, 0.1)};
                both[1].weight = 0.0f;
                both[1].fadeWeight = 1.0f;
                both[1].fadeStart = start;
                both[1].fadeDuration = static_cast<float>(kSeconds);
                const Jump faded = jumpAt(stage, 4, start, [&] { stage.play(4, both); });
                std::printf("%-10s crossfade      place %.2g extents, speed %.2g extents/s\n", file.c_str(),
                            faded.place / extent, faded.speed / extent);
                Jump jumps[3];
                for (uint32_t i = 0; i < 3; ++i) {
                    const SupplePlaybackDesc desc = i < 2 ? goingOver(kKinds[i]) : SupplePlaybackDesc{};
                    jumps[i] = jumpAt(stage, i, start, [&] { stage.play(i, 2, 0.1, desc); });
                    std::printf("%-10s %-14s place %.2g extents, speed %.2g extents/s\n", file.c_str(),
                                i < 2 ? nameOf(kKinds[i]) : "none", jumps[i].place / extent, jumps[i].speed / extent);
                }
                for (const Jump& jump : {jumps[0], jumps[1]}) {
                    EXPECT_LT(jump.place, 2e-6 * extent);
                    EXPECT_LT(jump.speed, 0.35 * jumps[2].speed);
                    EXPECT_LT(jump.speed, 0.2 * faded.speed);
                }
                EXPECT_GT(jumps[2].place, 0.01 * extent);
                for (const double part : {0.0, 0.01, 0.3, 0.5, 0.9, 0.999}) {
                    EXPECT_EQ(stage.run(start + part * kSeconds), 0u) << part << " " << mappingName(mapping);
                }
                // Smoothly, then it is over: the bits of an instance that plays alone.
                for (uint32_t i = 0; i < 2; ++i) {
                    EXPECT_LT(apart(placesAt(stage, i, start + 0.999 * kSeconds),
                                    placesAt(stage, 3, start + 0.999 * kSeconds)),
                              2e-4 * extent);
                }
                EXPECT_EQ(stage.run(start + kSeconds * (1.0 + 1e-6)), 0u);
                const size_t stride = 4 * size_t{stage.group().instances().poseLayout().stride};
                for (uint32_t i = 0; i < 3; ++i) {
                    const auto first = stage.poses.begin() + static_cast<ptrdiff_t>(i * stride);
                    const auto plain = stage.poses.begin() + static_cast<ptrdiff_t>(3 * stride);
                    EXPECT_TRUE(std::equal(first, first + static_cast<ptrdiff_t>(stride), plain)) << i;
                }
            }
        }
    }
}

TEST_F(Transitions, AreFunctionsOfTimeAlone) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const auto poses = [&](const std::vector<double>& frames, bool grows) {
        PlayedGroup stage(own, transitingGroup(own.asset(kWren), 2));
        EXPECT_TRUE(stage.crowd.valid());
        for (uint32_t i = 0; i < 2; ++i) {
            stage.play(i, 1, 0.3 * i);
        }
        EXPECT_EQ(stage.run(1.0), 0u);
        for (uint32_t i = 0; i < 2; ++i) {
            stage.play(i, 4, 0.0, goingOver(kKinds[i]));
        }
        for (const double time : frames) {
            EXPECT_EQ(stage.run(time), 0u);
        }
        if (grows) {
            EXPECT_EQ(suppleSetCapacity(stage.handle(), stage.crowd.group(), 6), SUPPLE_OK);
        }
        EXPECT_EQ(stage.run(1.17), 0u);
        stage.poses.resize(8 * size_t{stage.group().instances().poseLayout().stride});
        return stage.poses;
    };
    const std::vector<float> direct = poses({}, false);
    EXPECT_EQ(poses({1.0, 1.03, 1.06, 1.09, 1.12}, false), direct);
    EXPECT_EQ(poses({1.29, 1.4, 0.2, 1.1}, false), direct) << "back and forth, also to before it began";
    EXPECT_EQ(poses({1.05}, true), direct) << "made anew";
}

TEST_F(Transitions, GoOnWhenTheyAreInterrupted) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_WIDE);
    ASSERT_TRUE(own.valid());
    PlayedGroup stage(own, transitingGroup(own.asset(kWren), 2));
    ASSERT_TRUE(stage.crowd.valid());
    const double extent = stage.extent();
    for (uint32_t i = 0; i < 2; ++i) {
        stage.play(i, 2, 0.2);
        EXPECT_EQ(stage.run(1.0), 0u);
        stage.play(i, 3, 0.0, goingOver(kKinds[i]));
        for (const double later : {0.1, 0.2}) { // then twice more
            const Jump jump = jumpAt(stage, i, 1.0 + later, [&] { stage.play(i, 0, 0.0, goingOver(kKinds[i])); });
            std::printf("%s interrupted: place %.2g extents, speed %.2g extents/s\n", nameOf(kKinds[i]),
                        jump.place / extent, jump.speed / extent);
            EXPECT_LT(jump.place, 2e-6 * extent);
            EXPECT_LT(jump.speed, 0.1 * extent);
            EXPECT_EQ(stage.run(1.05 + later), 0u);
        }
        // At the very moment at which one has begun: the speed is still the first one's.
        const Jump twice = jumpAt(stage, i, 3.0, [&] {
            stage.play(i, 3, 0.0, goingOver(kKinds[i]));
            stage.play(i, 4, 0.0, goingOver(kKinds[i]));
        });
        EXPECT_LT(twice.place, 2e-6 * extent);
        EXPECT_LT(twice.speed, 0.1 * extent);
    }
}

TEST_F(Transitions, AreKeptWhenTheSpeedChanges) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    PlayedGroup stage(own, transitingGroup(own.asset(kPip), 2));
    ASSERT_TRUE(stage.crowd.valid());
    for (uint32_t i = 0; i < 2; ++i) {
        stage.play(i, 1, 0.2);
        EXPECT_EQ(stage.run(1.0), 0u);
        stage.play(i, 2, 0.1, goingOver(kKinds[i]));
        EXPECT_EQ(stage.run(1.05), 0u);
        const std::vector<float> before = stage.poses;
        const Places shown = placesAt(stage, i, 1.05);
        SupplePlaybackLayer faster = PlayedGroup::loops(2, 0.1 + 1.05);
        faster.speed = 1.5f;
        faster.startTime = 1.05;
        stage.play(i, {&faster, 1}, goingOver(kKinds[i], 0.0, SUPPLE_PLAYBACK_KEEP_TRANSITION));
        EXPECT_LT(apart(placesAt(stage, i, 1.05), shown), 1e-5 * stage.extent());
        own.cancel(stage.crowd.group());
        EXPECT_EQ(stage.run(1.1), 0u);
        EXPECT_GT(apart(placesAt(stage, i, 1.1), shown), 1e-3 * stage.extent());
        stage.play(i, 2, 0.1);
        EXPECT_EQ(stage.run(1.05), 0u);
        EXPECT_NE(stage.poses, before) << "without the flag it is over";
    }
}

TEST_F(Transitions, StartFromTheBindPoseAtOnce) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    PlayedGroup stage(own, transitingGroup(own.asset(kPip), 2));
    ASSERT_TRUE(stage.crowd.valid());
    stage.play(0, 1, 0.2, goingOver(SUPPLE_TRANSITION_DEAD_BLENDING));
    stage.play(1, 1, 0.2);
    EXPECT_EQ(apart(placesAt(stage, 0, 0.1), placesAt(stage, 1, 0.1)), 0.0);
    EXPECT_EQ(stage.run(0.1), 0u);
}

TEST_F(Transitions, LeadOutOfWhatModifiersHaveLeft) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        PlayedGroup stage(own, transitingGroup(own.asset(kPip), 2, SUPPLE_SKINNING_LINEAR, SUPPLE_GROUP_MODIFIERS));
        ASSERT_TRUE(stage.crowd.valid());
        const double extent = stage.extent();
        const uint32_t hips = 1;
        for (uint32_t i = 0; i < 2; ++i) {
            stage.play(i, 0, 0.2);
            SuppleModifier lies{};
            lies.kind = SUPPLE_MODIFIER_HAND_OVER;
            lies.joint = hips;
            lies.weight = 1.0f;
            lies.target[1] = 0.1 * extent;
            lies.rotation[0] = lies.rotation[3] = 0.70710678f; // on its back
            stage.modify(i, lies);
            EXPECT_EQ(stage.run(1.0), 0u);
            const Places shown = placesAt(stage, i, 1.0);
            stage.play(i, 2, 0.0, goingOver(kKinds[i], kSeconds, SUPPLE_PLAYBACK_FROM_MODIFIED));
            stage.modify(i, std::span<const SuppleModifier>());
            EXPECT_LT(apart(placesAt(stage, i, 1.0), shown), 1e-5 * extent);
            EXPECT_EQ(stage.run(1.1), 0u);
            EXPECT_GT(apart(placesAt(stage, i, 1.1), shown), 0.01 * extent) << "it gets up";
        }
    }
}

TEST_F(Transitions, ChangeMorphWeightsSmoothly) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    PlayedGroup stage(own, transitingGroup(own.asset(kWren), 2));
    ASSERT_TRUE(stage.crowd.valid());
    const skinning::PoseLayout layout = stage.group().instances().poseLayout();
    ASSERT_GT(layout.morphCount, 0u);
    const auto weights = [&](uint32_t i) {
        const size_t first = 4 * (size_t{i} * layout.stride + layout.morphWeights);
        return std::vector<float>(stage.poses.begin() + static_cast<ptrdiff_t>(first),
                                  stage.poses.begin() + static_cast<ptrdiff_t>(first + layout.morphCount));
    };
    const uint32_t wave = 4;
    float moved = 0.0f;
    for (uint32_t i = 0; i < 2; ++i) {
        for (const double start : {0.4, 0.9, 1.3}) {
            stage.play(i, wave, 0.0);
            EXPECT_EQ(stage.run(start), 0u);
            const std::vector<float> shown = weights(i);
            stage.play(i, 0, 0.0, goingOver(kKinds[i]));
            EXPECT_EQ(stage.run(start), 0u);
            std::vector<float> last = weights(i);
            for (uint32_t t = 0; t < layout.morphCount; ++t) {
                EXPECT_NEAR(last[t], shown[t], 1e-6f);
            }
            for (double later = 0.01; later < kSeconds; later += 0.01) {
                EXPECT_EQ(stage.run(start + later), 0u);
                const std::vector<float> now = weights(i);
                for (uint32_t t = 0; t < layout.morphCount; ++t) {
                    EXPECT_TRUE(now[t] >= 0.0f && now[t] <= 1.0f) << now[t];
                    EXPECT_NEAR(now[t], last[t], 0.2f) << "no jump";
                    moved = std::max(moved, std::abs(now[t] - shown[t]));
                }
                last = now;
            }
            // The host's own stand before them.
            const std::vector<float> said(stage.character().morphs.targets.size(), 0.25f);
            EXPECT_EQ(suppleSetMorphWeights(stage.handle(), stage.instances[i], said.data(),
                                            static_cast<uint32_t>(said.size())),
                      SUPPLE_OK);
            EXPECT_EQ(stage.run(start + 0.1), 0u);
            EXPECT_EQ(weights(i), std::vector<float>(layout.morphCount, 0.25f));
            EXPECT_EQ(suppleSetMorphWeights(stage.handle(), stage.instances[i], nullptr, 0), SUPPLE_OK);
        }
    }
    EXPECT_GT(moved, 0.05f) << "weights change in this clip";
}

TEST_F(Transitions, LeaveTheRootWhereItTravels) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_WIDE);
    ASSERT_TRUE(own.valid());
    PlayedGroup stage(own, transitingGroup(own.asset(kWren), 2));
    ASSERT_TRUE(stage.crowd.valid());
    const double extent = stage.extent();
    const glm::mat4 place = glm::rotate(glm::translate(glm::mat4(1.0f), {3.0f, 0.0f, 1.0f}), 0.7f, {0.0f, 1.0f, 0.0f});
    for (uint32_t i = 0; i < 2; ++i) {
        SupplePlaybackDesc walks{};
        walks.rootMotion = SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW;
        walks.flags = SUPPLE_PLAYBACK_TRAVEL;
        stage.place(i, place);
        stage.play(i, 1, 0.0, walks);
        EXPECT_EQ(stage.run(0.7), 0u);
        const Places start = placesAt(stage, i, 0.0), shown = placesAt(stage, i, 0.7);
        EXPECT_GT(apart(start, shown), 0.1 * extent) << "it has travelled";
        // How far: hosts fold it into the transform.
        SuppleClipLayer layer{};
        layer.clip = 1;
        layer.flags = SUPPLE_LAYER_LOOP;
        layer.weight = 1.0f;
        layer.time = 0.7;
        SupplePoseDesc pose{};
        pose.structSize = sizeof pose;
        pose.layers = &layer;
        pose.layerCount = 1;
        pose.rootMotion = walks.rootMotion;
        SuppleRootMotion moved{};
        moved.structSize = sizeof moved;
        ASSERT_EQ(suppleGetRootMotion(stage.handle(), own.asset(kWren), &pose, &moved), SUPPLE_OK);
        SupplePlaybackDesc stands = goingOver(kKinds[i]);
        stands.rootMotion = walks.rootMotion;
        stage.play(i, 0, 0.0, stands);
        stage.place(i, place * glm::make_mat4(moved.transform));
        EXPECT_LT(apart(placesAt(stage, i, 0.7), shown), 1e-5 * extent);
        EXPECT_EQ(stage.run(0.8), 0u);
        stage.play(i, 0, 0.0);
    }
}

TEST_F(Transitions, TakeNoSpeedFromWhereClipsJump) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    cage::Character tube = riggedTube({.segments = 6, .sides = 6, .joints = 3, .morphTargets = 0});
    // A joint that goes two units up in a second and begins anew, and turns by a third of a turn; another that stands.
    tube.clips.push_back(
        clipOf({channel(1, cage::ChannelPath::translation, {0, 1}, {0, 0, 0, 0, 2, 0}),
                channel(1, cage::ChannelPath::rotation, {0, 1}, {0, 0, 0, 1, 0.8660254f, 0, 0, 0.5f})}));
    tube.clips.push_back(clipOf({channel(1, cage::ChannelPath::translation, {0, 1}, {0, 1, 0, 0, 1, 0})}));
    const auto jumps = static_cast<uint32_t>(tube.clips.size()) - 2;
    PlayedGroup stage(own, transitingGroup(own.createAsset(tube), 2));
    ASSERT_TRUE(stage.crowd.valid());
    for (uint32_t i = 0; i < 2; ++i) {
        for (const double start : {0.996, 1.004, 2.0}) { // the loop ends within a step of each
            stage.play(i, jumps, 0.0);
            const double shown = placesAt(stage, i, start)[1].y;
            stage.play(i, jumps + 1, 0.0, goingOver(kKinds[i]));
            const double stands = placesAt(stage, i, 9.0)[1].y;
            double farthest = 0.0; // outside of the two
            for (const double later : {0.01, 0.03, 0.06, 0.1, 0.15, 0.2}) {
                const double height = placesAt(stage, i, start + later)[1].y;
                farthest = std::max({farthest, height - std::max(shown, stands), std::min(shown, stands) - height});
            }
            EXPECT_LT(farthest, 0.15) << "0.072 s of 2 units a second, at " << start;
            EXPECT_EQ(stage.run(start + 0.1), 0u);
        }
    }
}

TEST_F(Transitions, HoldWithLayersOfAllKinds) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        PlayedGroup stage(own, transitingGroup(own.asset(kPip), 2));
        ASSERT_TRUE(stage.crowd.valid());
        const std::vector<float> halves(stage.character().skin.joints.size(), 0.5f);
        SuppleMaskDesc mask{};
        mask.structSize = sizeof mask;
        mask.mask = 1;
        mask.jointMask = halves.data();
        mask.jointMaskCount = static_cast<uint32_t>(halves.size());
        EXPECT_EQ(suppleSetMask(stage.handle(), stage.crowd.group(), &mask), SUPPLE_OK);
        for (uint32_t i = 0; i < 2; ++i) {
            SupplePlaybackLayer layers[] = {PlayedGroup::loops(0, 0.0), PlayedGroup::loops(2, 0.3)};
            layers[1].mode = SUPPLE_LAYER_ADDITIVE;
            layers[1].mask = 1;
            stage.play(i, 1, 0.2);
            EXPECT_EQ(stage.run(1.0), 0u);
            const Jump jump = jumpAt(stage, i, 1.0, [&] { stage.play(i, layers, goingOver(kKinds[i])); });
            EXPECT_LT(jump.place, 2e-6 * stage.extent());
            EXPECT_LT(jump.speed, 0.1 * stage.extent());
            EXPECT_EQ(stage.run(1.1), 0u);
        }
    }
}

TEST_F(Transitions, AreUploadedOnce) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    PlayedGroup stage(own, transitingGroup(own.asset(kPip), 3));
    ASSERT_TRUE(stage.crowd.valid());
    const auto uploaded = [&] { return own.uploadedFor(stage.crowd.group()); };
    stage.play(1, 1, 0.0);
    EXPECT_EQ(stage.run(0.5), 0u);
    EXPECT_EQ(stage.run(0.5), 0u); // the lists of new instances take two frames
    stage.play(1, 1, 0.0);
    const uint64_t plain = uploaded();
    stage.play(1, 2, 0.0, goingOver(SUPPLE_TRANSITION_DEAD_BLENDING));
    const uint64_t nodes = stage.group().asset().clipTable->nodes.size();
    EXPECT_EQ(uploaded(), plain + 16 + 64 * nodes);
    EXPECT_EQ(uploaded(), 0u);
    stage.place(1, glm::translate(glm::mat4(1.0f), {1.0f, 0.0f, 0.0f}));
    EXPECT_EQ(uploaded(), plain) << "its words stay on the device";
    EXPECT_EQ(stage.run(0.6), 0u);
    // A frame that is cancelled takes them along.
    stage.play(2, 1, 0.0);
    EXPECT_EQ(stage.run(0.6), 0u);
    stage.play(2, 2, 0.0, goingOver(SUPPLE_TRANSITION_QUINTIC));
    own.cancel(stage.crowd.group());
    EXPECT_EQ(stage.run(0.65), 0u);
}

} // namespace
} // namespace supple::test
