// A group whose poses the host sets, in frames that have a time, beside one that plays.
#pragma once

#include "tests/support/played_group.h"

#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <vector>

namespace supple::test {

inline SuppleGroupDesc posedGroup(SuppleAsset asset, uint32_t capacity, uint32_t flags,
                                  SuppleSkinning skinning = SUPPLE_SKINNING_LINEAR) {
    SuppleGroupDesc desc = playedGroup(asset, capacity, flags, skinning);
    desc.poseSource = SUPPLE_POSES_SET;
    return desc;
}

/// What says the pose of an instance; the last from where a group that plays has the joints.
enum class By { clip, layers, clipWithModifiers, matrices };

/// A group whose instances are posed by calls, by one of the character's clips.
class PosedGroup : public PlayedGroup {
public:
    PosedGroup(CrowdContext& context, const SuppleGroupDesc& desc, uint32_t clip = 2)
        : PlayedGroup(context, desc), clip_(clip) {}

    [[nodiscard]] double within(double time) const { return std::fmod(time, character().clips[clip_].duration); }
    void poseClip(uint32_t i, double time) const {
        EXPECT_EQ(suppleSetClipPose(handle(), instances[i], clip_, time), SUPPLE_OK);
    }
    void poseLayer(uint32_t i, double time) const {
        SuppleClipLayer layer{};
        layer.clip = clip_;
        layer.weight = 1.0f;
        layer.time = time;
        SupplePoseDesc desc{};
        desc.structSize = sizeof desc;
        desc.layers = &layer;
        desc.layerCount = 1;
        EXPECT_EQ(suppleSetPose(handle(), instances[i], &desc), SUPPLE_OK);
    }
    void poseMatrices(uint32_t i, const std::vector<float>& matrices) const {
        EXPECT_EQ(
            suppleSetMatrixPose(handle(), instances[i], matrices.data(), static_cast<uint32_t>(matrices.size() / 16)),
            SUPPLE_OK);
    }
    void frame(double time) {
        crowd.context().setTime(time);
        crowd.context().run(crowd.group());
        poses = as<float>(crowd.read(crowd.output().info.poses));
    }
    /// The deformed cage of an instance in the last frame.
    [[nodiscard]] std::vector<float> cage(uint32_t i = 0) const {
        const std::vector<float> floats = as<float>(crowd.read(crowd.output().info.deformedCage));
        const size_t stride = size_t{4} * group().instances().cageStride();
        const auto begin = floats.begin() + static_cast<ptrdiff_t>(instances[i].slot * stride);
        return {begin, begin + static_cast<ptrdiff_t>(4 * size_t{character().cage.vertexCount()})};
    }
    /// The palette of the last frame, three rows a joint.
    [[nodiscard]] std::vector<float> palette(uint32_t i) const {
        const skinning::PoseLayout& layout = group().instances().poseLayout();
        const auto begin = poses.begin() + static_cast<ptrdiff_t>(4 * size_t{instances[i].slot} * layout.stride);
        return {begin, begin + static_cast<ptrdiff_t>(12 * size_t{layout.jointCount})};
    }

private:
    uint32_t clip_;
};

inline glm::mat4 placedAt(double time) {
    const auto t = static_cast<float>(time);
    return glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(1.5f * t, 0.0f, 0.3f * std::sin(3.0f * t))), t,
                       glm::vec3(0.0f, 1.0f, 0.0f));
}

/// Two groups whose instances are posed alike, of which one meets with something.
struct TwoPosedGroups {
    TwoPosedGroups(CrowdContext& context, const SuppleGroupDesc& otherDesc, const SuppleGroupDesc& plainDesc,
                   uint32_t clip)
        : other(context, otherDesc, clip), plain(context, plainDesc, clip) {}
    /// A frame of each, a sixtieth of a second behind the one of the step before.
    void run(uint32_t step) {
        for (PosedGroup* const group : {&other, &plain}) {
            for (uint32_t i = 0; i < group->instances.size(); ++i) {
                group->poseClip(i, group->within(step / 60.0 + 0.1 * i));
            }
            group->frame(step / 60.0);
        }
    }

    PosedGroup other, plain;
};

/// Nothing changes where the one group has room for 9 instances from a step on, and for 5 from another. `off`: how far
/// an instance is from that of the other group.
template <class Off>
void expectTheSameInAnotherCapacity(TwoPosedGroups& both, uint32_t nine, uint32_t five, const Off& off) {
    for (uint32_t step = 0; step < five + 15; ++step) {
        if (step == nine || step == five) {
            EXPECT_EQ(suppleSetCapacity(both.other.handle(), both.other.crowd.group(), step == nine ? 9 : 5),
                      SUPPLE_OK);
        }
        both.run(step);
        for (uint32_t i = 0; i < both.plain.instances.size(); ++i) {
            EXPECT_EQ(off(i), 0.0) << step;
        }
    }
}
/// Nor where it has frames that are cancelled, and behind these an instance that jumps.
template <class Off>
void expectTheSameBehindCancelledFrames(TwoPosedGroups& both, const Off& off) {
    for (uint32_t step = 0; step < 30; ++step) {
        if (step % 5 == 3 || step == 0) {
            both.other.poseClip(0, both.other.within(0.5));
            both.other.crowd.context().setTime(step / 60.0);
            both.other.crowd.context().cancel(both.other.crowd.group());
            for (PosedGroup* const group : {&both.other, &both.plain}) { // behind it
                group->place(1, placedAt(step));
                group->crowd.teleport(group->instances[1]);
            }
        }
        both.run(step);
        EXPECT_TRUE(off(0) == 0.0 && off(1) == 0.0) << step;
    }
}

/// Nor where the capacity changes behind a frame that is recorded and then cancelled; twice, so that what the first
/// change hands over never reaches its new place.
template <class Pair, class Off>
void expectTheSameBehindCancelledCapacities(Pair& both, const Off& off, bool plays) {
    CrowdContext& own = both.other.crowd.context();
    for (uint32_t step = 0; step < 24; ++step) {
        if (step == 8 || step == 16) {
            EXPECT_EQ(suppleSetCapacity(own.handle(), both.other.crowd.group(), step), SUPPLE_OK);
            if (plays) {
                EXPECT_EQ(suppleSetTime(own.handle(), both.other.crowd.group(), step / 60.0), SUPPLE_OK);
            }
            own.beginFrame();
            own.setTime(step / 60.0);
            Commands dropped(own.device());
            dropped.record([&](VkCommandBuffer commands) {
                const SuppleGroup group = both.other.crowd.group();
                EXPECT_EQ(own.record(commands, {&group, 1}), SUPPLE_OK);
            });
            EXPECT_EQ(suppleSetCapacity(own.handle(), both.other.crowd.group(), step + 1), SUPPLE_OK);
            EXPECT_EQ(suppleCancelFrame(own.handle()), SUPPLE_OK);
        }
        both.run(step);
        EXPECT_TRUE(off(0) == 0.0 && off(1) == 0.0) << step;
    }
}

/// The joints of an instance of a group that stands where placedAt() says, in model space.
inline std::vector<float> jointMatrices(const PlayedGroup& played, uint32_t i, double time) {
    std::vector<float> matrices;
    for (uint32_t j = 0; j < played.character().skin.joints.size(); ++j) {
        const glm::mat4 m(glm::inverse(glm::dmat4(placedAt(time))) * played.jointOf(i, j));
        matrices.insert(matrices.end(), glm::value_ptr(m), glm::value_ptr(m) + 16);
    }
    return matrices;
}

inline void pose(PosedGroup& set, const PlayedGroup& played, uint32_t i, double time, By by) {
    switch (by) {
    case By::matrices:
        return set.poseMatrices(i, jointMatrices(played, i, time));
    case By::layers:
        return set.poseLayer(i, set.within(time));
    default:
        return set.poseClip(i, set.within(time));
    }
}

} // namespace supple::test
