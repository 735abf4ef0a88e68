// Instances that surely are out of a view's sight are not posed, and nobody sees a difference.
#include "runtime/culling/out_of_sight.h"

#include "runtime/played_bounds.h"
#include "skinning/joints.h"
#include "skinning/played_pose.h"
#include "tests/support/boxes.h"
#include "tests/support/centers_reference.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/lod_surface.h"
#include "tests/support/meshes.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/test_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <memory>
#include <random>
#include <vector>

namespace supple::test {
namespace {

using cage::ChannelPath;

/// It walks along x, turns, and waves.
cage::Character walker() {
    cage::Character tube = riggedTube({.segments = 6, .sides = 6, .joints = 3, .morphTargets = 1});
    tube.clips.push_back(
        clipOf({channel(1, ChannelPath::translation, {0, 1, 2}, {0, 0, 0, 1.5f, 0.25f, 0.5f, 4, 0, 0}),
                channel(1, ChannelPath::rotation, {0, 2}, {0, 0, 0, 1, 0, 0.6f, 0, 0.8f}),
                channel(2, ChannelPath::rotation, {0, 1, 2}, {0, 0, 0, 1, 0, 0, 0.6f, 0.8f, 0, 0, 0, 1})}));
    tube.clips.push_back(clipOf({channel(3, ChannelPath::translation, {0, 1}, {2, 0, 0, 2, 1, 0}),
                                 channel(1, ChannelPath::translation, {0, 1}, {0, 0, 0, -1, 0, 2})}));
    return tube;
}

std::vector<glm::dvec3> moved(std::vector<glm::dvec3> points, const glm::dmat4& place) {
    for (glm::dvec3& p : points) {
        p = glm::dvec3(place * glm::dvec4(p, 1.0));
    }
    return points;
}

TEST(PlayedBounds, HoldWhatPlays) {
    const cage::Character tube = walker();
    const skinning::Reach reach = skinning::reachOf(tube);
    ASSERT_EQ(reach.anchor, 1u);
    const skinning::Rig rig = skinning::makeRig(tube);
    skinning::PoseMemory memory(tube);
    const skinning::Centers centers = skinning::findCenters(tube);
    runtime::PlayedBounds bounds(tube, {}, false, 1);
    const skinning::SkinnedBounds skinned({skinning::SkinningMode::centersOfRotation, &centers});
    runtime::PlayedBounds about(tube, skinned, false, 1);
    Noise noise(7);
    size_t held = 0, unbounded = 0;
    for (uint32_t run = 0; run < 400; ++run) {
        SCOPED_TRACE(run);
        skinning::PlaybackLayer layers[2];
        layers[0] = {.clip = 0, .loop = run % 5 != 0, .start = 2.0, .offset = 1.7 * noise(), .speed = 2.0f * noise()};
        layers[1] = {.clip = 1, .loop = true, .weight = 0.5f + 0.5f * noise()};
        const uint32_t axes = run % 8; // all mixes of ground, height and yaw
        const skinning::PlaybackDesc desc{std::span(layers).first(1 + run % 2), {1, axes}, run % 3 != 0};
        bounds.set(0, desc);
        about.set(0, desc);
        const double time = 20.0 * static_cast<double>(noise());
        const auto box = bounds.of(0, time, reach, {});
        if (axes == skinning::kRootYaw || axes == (skinning::kRootYaw | skinning::kRootHeight)) {
            EXPECT_FALSE(box.has_value());
            ++unbounded;
            continue;
        }
        ASSERT_TRUE(box.has_value());
        skinning::poseNodes(tube, rig, desc, time, {}, memory);
        std::vector<skinning::Affine> palette(tube.skin.joints.size());
        skinning::jointPalette(tube.skin, memory.nodes, glm::mat4(1.0f), palette);
        const std::vector<float> weights(memory.pose.morphWeights.begin(), memory.pose.morphWeights.end());
        const std::vector<glm::dvec3> morphed = skinning::morphOnCpu(tube.cage, tube.morphs, weights);
        const glm::dmat4 place = skinning::toMatrix(skinning::traveledBy(tube, desc, time));
        EXPECT_TRUE(holds(*box, boxAround(moved(skinning::deformOnCpu(morphed, tube.weights, palette), place))));
        EXPECT_TRUE(
            holds(*about.of(0, time, reach, {}),
                  boxAround(moved(skinAboutCenters(morphed, centersOf(centers), tube.weights, palette), place))));
        EXPECT_LT(glm::length(box->high - box->low), 150.0) << "it travels along, whatever the time";
        ++held;
    }
    std::printf("%zu held, %zu of which nobody knows\n", held, unbounded);
    skinning::PlaybackLayer adds{.clip = 0, .mode = skinning::LayerMode::additive};
    bounds.set(0, {{&adds, 1}, {}, false});
    EXPECT_FALSE(bounds.of(0, 0.0, reach, {}).has_value());
    skinning::PlaybackLayer stays{.clip = 0};
    bounds.set(0, {{&stays, 1}, {}, false});
    const uint32_t before = bounds.loopOf(0, 2.9);
    bounds.setTransition(0, {2.8, 3.0}); // what was shown moves on, where no clip has been
    EXPECT_FALSE(bounds.of(0, 2.9, reach, {}).has_value());
    EXPECT_NE(bounds.loopOf(0, 2.9), before);
    for (const double outside : {2.7, 3.1}) {
        EXPECT_TRUE(bounds.of(0, outside, reach, {}).has_value());
        EXPECT_EQ(bounds.loopOf(0, outside), before);
    }
    bounds.setTransition(0, {2.8, 3.0});
    bounds.setBindPose(0);
    const float weight = 3.0f;
    const auto bind = bounds.of(0, 0.0, reach, {&weight, 1});
    ASSERT_TRUE(bind.has_value());
    EXPECT_TRUE(holds(*bind, boxAround(skinning::morphOnCpu(tube.cage, tube.morphs, {&weight, 1}))));
}

/// The corners of all triangles that are drawn, sorted: places come in any order.
PositionBits drawn(const Crowd& crowd) {
    PositionBits corners;
    const LodSurface surface = readLodSurface(crowd);
    for (const std::array<uint32_t, 3>& triangle : surface.triangles) {
        for (const uint32_t vertex : triangle) {
            corners.push_back(surface.positions[vertex]);
        }
    }
    std::sort(corners.begin(), corners.end());
    return corners;
}

/// A ring of instances about a camera that turns.
class Ring {
public:
    static constexpr uint32_t kCount = 24;

    Ring(CrowdContext& context, SuppleAsset asset, SupplePoseSource poses, uint32_t flags,
         uint32_t viewFlags = SUPPLE_VIEW_CULL)
        : view(context, 300'000, viewFlags), poses_(poses) {
        SuppleGroupDesc desc{};
        desc.asset = asset;
        desc.capacity = kCount;
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.view = view.handle();
        desc.poseSource = poses;
        desc.flags = flags;
        crowd = std::make_unique<Crowd>(context, desc);
        for (uint32_t i = 0; i < kCount; ++i) {
            instances.push_back(crowd->spawn());
            const float angle = 6.2831853f * static_cast<float>(i) / kCount;
            const glm::mat4 place =
                glm::translate(glm::mat4(1.0f), 40.0f * glm::vec3(std::cos(angle), 0.0f, std::sin(angle)));
            EXPECT_EQ(suppleSetTransform(context.handle(), instances[i], &place[0][0]), SUPPLE_OK);
            if (poses == SUPPLE_POSES_PLAYBACK) {
                play(context, instances[i], i);
            }
        }
    }
    /// The frame at a time, from the camera's angle.
    void run(double time, float angle) {
        CrowdContext& context = crowd->context();
        if (poses_ == SUPPLE_POSES_PLAYBACK) {
            EXPECT_EQ(suppleSetTime(context.handle(), crowd->group(), time), SUPPLE_OK);
        } else {
            for (uint32_t i = 0; i < kCount; ++i) {
                EXPECT_EQ(suppleSetClipPose(context.handle(), instances[i], i % 2, time), SUPPLE_OK);
            }
        }
        const glm::vec3 to(std::cos(angle), 0.0f, std::sin(angle));
        const glm::mat4 seen =
            glm::perspectiveRH_ZO(0.9f, 1.0f, 0.1f, 200.0f) * glm::lookAt(glm::vec3(0.0f), to, glm::vec3(0, 1, 0));
        std::memcpy(view.camera.viewProjection, &seen, sizeof seen);
        view.camera.pixelsPerUnit = 300.0f;
        view.look({0, 0, 0});
        context.run(crowd->group());
    }
    [[nodiscard]] SuppleViewStatistics statistics() const { // of the last frame
        crowd->context().beginFrame();
        crowd->context().beginFrame();
        return view.statistics();
    }

    TestView view;
    std::unique_ptr<Crowd> crowd;
    std::vector<SuppleInstance> instances;

private:
    static void play(CrowdContext& context, SuppleInstance instance, uint32_t i) {
        SupplePlaybackLayer layer{};
        layer.clip = i % 2;
        layer.flags = SUPPLE_LAYER_LOOP;
        layer.weight = 1.0f;
        layer.speed = 1.0f;
        layer.offset = 0.1 * i;
        SupplePlaybackDesc desc{};
        desc.structSize = sizeof(desc);
        desc.layers = &layer;
        desc.layerCount = 1;
        desc.flags = i % 3 == 0 ? SUPPLE_PLAYBACK_TRAVEL : 0;
        desc.rootMotion = i % 3 == 0 ? SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW : 0;
        EXPECT_EQ(suppleSetPlayback(context.handle(), instance, &desc), SUPPLE_OK);
    }

    SupplePoseSource poses_;
};

class OutOfSight : public CrowdContexts, public testing::WithParamInterface<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, OutOfSight, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

TEST_P(OutOfSight, WhatIsDrawnIsTheSame) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    const SuppleAsset asset = context.createAsset(walker());
    for (const SupplePoseSource poses : {SUPPLE_POSES_PLAYBACK, SUPPLE_POSES_SET}) {
        SCOPED_TRACE(poses);
        Ring all(context, asset, poses, SUPPLE_GROUP_POSE_UNSEEN), seen(context, asset, poses, 0);
        uint32_t fewest = Ring::kCount, most = 0;
        for (int frame = 0; frame < 8; ++frame) {
            const double time = 0.4 * frame;
            const float angle = frame < 4 ? 0.15f * static_cast<float>(frame) : 2.0f * static_cast<float>(frame);
            all.run(time, angle);
            seen.run(time, angle);
            const PositionBits wanted = drawn(*all.crowd);
            EXPECT_GT(wanted.size(), 0u);
            EXPECT_TRUE(drawn(*seen.crowd) == wanted) << frame;
            const SuppleViewStatistics every = all.statistics(), own = seen.statistics();
            EXPECT_EQ(every.unposedInstanceCount, 0u);
            EXPECT_EQ(every.instanceCount, Ring::kCount);
            EXPECT_EQ(own.instanceCount, Ring::kCount);
            EXPECT_EQ(own.drawnInstanceCount, every.drawnInstanceCount);
            fewest = std::min(fewest, own.unposedInstanceCount);
            most = std::max(most, own.unposedInstanceCount);
        }
        std::printf("%u to %u of %u instances are not posed\n", fewest, most, Ring::kCount);
        EXPECT_GE(fewest, 14u) << "two of three are behind the camera or far to its sides";
        EXPECT_LT(most, Ring::kCount);
    }
}

TEST_P(OutOfSight, AllArePosedForWhomThatMatters) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    const SuppleAsset asset = context.createAsset(walker());
    Ring plain(context, asset, SUPPLE_POSES_PLAYBACK, 0);
    plain.run(0.0, 0.0f);
    EXPECT_GE(plain.statistics().unposedInstanceCount, 14u);
    Ring boxes(context, asset, SUPPLE_POSES_PLAYBACK, SUPPLE_GROUP_BOUNDS);
    boxes.run(0.0, 0.0f);
    EXPECT_EQ(boxes.statistics().unposedInstanceCount, 0u) << "the host reads the boxes of all";
    Ring looser(context, asset, SUPPLE_POSES_PLAYBACK, 0, 0);
    looser.run(0.0, 0.0f);
    EXPECT_EQ(looser.statistics().unposedInstanceCount, 0u) << "the view culls nothing";
    EXPECT_EQ(looser.statistics().drawnInstanceCount, Ring::kCount);
    {
        // Another group draws the instances, and nobody knows where from.
        SuppleGroupDesc desc{};
        desc.asset = asset;
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.rate = 2;
        desc.instancesOf = plain.crowd->group();
        Crowd follower(context, desc);
        ASSERT_TRUE(follower.valid());
        const SuppleGroup both[] = {plain.crowd->group(), follower.group()};
        context.run(both);
        EXPECT_EQ(plain.statistics().unposedInstanceCount, 0u);
    }
    // A group that is made when its leader is recorded already: not all is posed that it draws, so it waits.
    SuppleGroupDesc late{};
    late.asset = asset;
    late.scheme = SUPPLE_SCHEME_PM;
    late.rate = 2;
    late.instancesOf = plain.crowd->group();
    for (int frame = 0; frame < 3; ++frame) { // the follower is gone when the frames that had it have run
        plain.run(0.0, 0.0f);
    }
    std::unique_ptr<Crowd> follower;
    context.beginFrame();
    ASSERT_TRUE(context.device()
                    .submitAndWait([&](VkCommandBuffer commands) {
                        const SuppleGroup leader = plain.crowd->group();
                        EXPECT_EQ(context.record(commands, {&leader, 1}), SUPPLE_OK);
                        follower = std::make_unique<Crowd>(context, late);
                        const SuppleGroup own = follower->group();
                        EXPECT_EQ(context.record(commands, {&own, 1}), SUPPLE_OK);
                    })
                    .ok());
    for (const VkDrawIndexedIndirectCommand& draw : follower->draws()) {
        EXPECT_EQ(draw.instanceCount, 0u);
    }
    follower.reset();
    for (int frame = 0; frame < 3; ++frame) { // the frames that had the follower have run by then
        plain.run(0.0, 0.0f);
    }
    EXPECT_GE(plain.statistics().unposedInstanceCount, 14u);
}

TEST(FindUnseen, AHullIsSeenAsAllItsBoxesAre) {
    std::mt19937 random(53);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    std::array<uint32_t, 3> found{};
    for (uint32_t run = 0; run < 30000; ++run) {
        const uint32_t count = 1 + run % 5;
        runtime::InstanceSlots slots(count + 1, 1, 1);
        runtime::BoxRuns boxes(count + 1);
        const float spread = std::pow(10.0f, 2.0f * unit(random)), far = run % 3 == 0 ? 1e5f : 3.0f;
        const glm::vec3 middle = far * glm::vec3(unit(random), unit(random), unit(random));
        for (uint32_t i = 0; i <= count; ++i) {
            (void)slots.create();
            const glm::dvec3 at(middle + spread * glm::vec3(unit(random), unit(random), unit(random)));
            const glm::dvec3 half(std::abs(unit(random)), 0.5, 1e-3);
            boxes.set(i, {at - half, at + half});
        }
        slots.setVisible(count, false);
        boxes.setUnknown(count); // nobody looks at it
        shared::CullView view{};
        for (size_t k = 0; k < 6; ++k) { // some of them touch a box
            const glm::vec3 normal = glm::normalize(glm::vec3(unit(random), unit(random), unit(random) + 1e-3f));
            const float distance = k == 0 ? spread * unit(random) : 3.0f * spread + 2.0f;
            const float side = k == 0 && run % 2 == 0 ? 1.0f : 0.0f;
            const float offset = distance - glm::dot(normal, middle) - side * std::abs(normal.y) * 0.5f;
            const float plane[] = {normal.x, normal.y, normal.z, offset};
            std::copy_n(plane, 4, view.planes + 4 * k);
        }
        view.camera.focal = 100.0f;
        view.farthest = run % 4 == 0 ? far + 2.0f * spread * std::abs(unit(random)) : 0.0f;
        view.smallest = run % 7 == 0 ? std::pow(10.0f, 2.0f * unit(random)) : 0.0f;
        std::vector<uint8_t> all(count + 1);
        runtime::findUnseen(view, boxes, all);
        const auto hidden = std::count(all.begin(), all.end() - 1, uint8_t{1});
        const runtime::Sight sight = runtime::sightOf(view, runtime::hullOf(boxes, slots));
        ++found[static_cast<size_t>(sight)];
        ASSERT_TRUE(sight != runtime::Sight::seen || hidden == 0) << "run " << run;
        ASSERT_TRUE(sight != runtime::Sight::unseen || hidden == static_cast<ptrdiff_t>(count)) << "run " << run;
    }
    for (const uint32_t times : found) {
        EXPECT_GT(times, 1000u);
    }
    runtime::InstanceSlots slots(1, 1, 1);
    runtime::BoxRuns unknown(1);
    unknown.setUnknown(0);
    EXPECT_EQ(runtime::sightOf({}, runtime::hullOf(unknown, slots)), runtime::Sight::mixed) << "nobody is there";
    (void)slots.create();
    EXPECT_EQ(runtime::sightOf({}, runtime::hullOf(unknown, slots)), runtime::Sight::mixed);
    unknown.set(0, {glm::dvec3(-1.0, std::nan(""), -1.0), glm::dvec3(1.0)});
    EXPECT_EQ(runtime::sightOf({}, runtime::hullOf(unknown, slots)), runtime::Sight::mixed);
    unknown.set(0, {glm::dvec3(-1.0), glm::dvec3(1.0)});
    EXPECT_EQ(runtime::sightOf({}, runtime::hullOf(unknown, slots)), runtime::Sight::seen) << "it sees everything";
}

TEST(FindUnseen, WhatIsNotFiniteIsSeen) {
    shared::CullView view{};
    view.planes[0] = 1.0f; // x >= 0
    const auto unseen = [&](double low, double high) {
        runtime::BoxRuns boxes(1);
        boxes.set(0, {glm::dvec3(low), glm::dvec3(high)});
        uint8_t found = 2;
        runtime::findUnseen(view, boxes, {&found, 1});
        return found;
    };
    EXPECT_EQ(unseen(-2.0, -1.0), 1);
    EXPECT_EQ(unseen(-2.0, 1.0), 0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(unseen(nan, nan), 0);
    view.farthest = 5.0f;
    EXPECT_EQ(unseen(3.0, 4.0), 1) << "5.2 away";
    EXPECT_EQ(unseen(2.0, 4.0), 0);
    view.farthest = 0.0f;
    view.camera.focal = 100.0f;
    view.smallest = 2.0f;
    EXPECT_EQ(unseen(100.0, 101.0), 1) << "half a pixel";
    EXPECT_EQ(unseen(10.0, 11.0), 0);
    EXPECT_EQ(unseen(nan, nan), 0);
    runtime::BoxRuns unknown(1);
    unknown.setUnknown(0);
    view.farthest = 5.0f;
    uint8_t found = 2;
    runtime::findUnseen(view, unknown, {&found, 1});
    EXPECT_EQ(found, 0);
}

} // namespace
} // namespace supple::test
