// What the API tells of clips beside their names: markers, and the boxes that hold their cages and surfaces.
#include "skinning/clip_table.h"
#include "skinning/pose.h"
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/read_character.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sample_assets.h"
#include "tests/support/skinnings.h"
#include "tests/support/walkers.h"
#include "tools/gltf/writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

namespace supple::test {
namespace {

using Times = std::vector<std::pair<std::string, double>>;

/// Bends and twists, with markers; "still" has none.
cage::Character markedTube() {
    cage::Character tube = riggedTube({.segments = 8, .sides = 8, .joints = 3});
    const glm::quat bent = glm::angleAxis(1.9f, glm::vec3(0.0f, 0.0f, 1.0f));
    const glm::quat twisted = glm::angleAxis(1.5f, glm::vec3(1.0f, 0.0f, 0.0f));
    tube.clips.push_back(clipOf(
        {channel(2, cage::ChannelPath::rotation, {0, 1, 2}, {0, 0, 0, 1, bent.x, bent.y, bent.z, bent.w, 0, 0, 0, 1}),
         channel(3, cage::ChannelPath::rotation, {0, 2}, {0, 0, 0, 1, twisted.x, twisted.y, twisted.z, twisted.w})}));
    tube.clips[0].name = "walk";
    tube.clips[0].markers = {{"left", 0.0}, {"right", 1.0}, {"end", 2.0}};
    tube.clips.push_back(clipOf({channel(2, cage::ChannelPath::translation, {0}, {3, 0, 0})}));
    tube.clips[1].name = "still";
    return tube;
}

class ClipFacts : public CrowdContexts {
protected:
    void SetUp() override {
        CrowdContexts::SetUp();
        if (!HasFatalFailure()) {
            own = &context(SUPPLE_MAPPING_AUTO);
            ASSERT_TRUE(own->valid());
            tube = own->createAsset(markedTube());
        }
    }
    [[nodiscard]] Times between(double from, double to, uint32_t flags, uint32_t room = 16) const {
        std::vector<SuppleClipMarker> markers(room);
        uint32_t count = room;
        const SuppleResult result =
            suppleGetClipMarkersBetween(own->handle(), tube, 0, from, to, flags, markers.data(), &count);
        EXPECT_EQ(result, count > room ? SUPPLE_INCOMPLETE : SUPPLE_OK);
        Times times;
        for (uint32_t m = 0; m < std::min(room, count); ++m) {
            times.emplace_back(markers[m].name, markers[m].time);
        }
        return times;
    }

    CrowdContext* own = nullptr;
    SuppleAsset tube{};
};

TEST_F(ClipFacts, Markers) {
    const ValidationGuard guard;
    uint32_t count = 7;
    EXPECT_EQ(suppleGetClipMarkers(own->handle(), tube, 1, nullptr, &count), SUPPLE_OK);
    EXPECT_EQ(count, 0u);
    EXPECT_EQ(suppleGetClipMarkers(own->handle(), tube, 0, nullptr, &count), SUPPLE_OK);
    ASSERT_EQ(count, 3u);
    std::vector<SuppleClipMarker> markers(count);
    EXPECT_EQ(suppleGetClipMarkers(own->handle(), tube, 0, markers.data(), &count), SUPPLE_OK);
    EXPECT_STREQ(markers[0].name, "left");
    EXPECT_STREQ(markers[2].name, "end");
    EXPECT_EQ(markers[2].time, 2.0);
    count = 1;
    markers[1].name = nullptr;
    EXPECT_EQ(suppleGetClipMarkers(own->handle(), tube, 0, markers.data(), &count), SUPPLE_INCOMPLETE);
    EXPECT_EQ(count, 3u);
    EXPECT_EQ(markers[1].name, nullptr) << "no more than there was room for";
}

TEST_F(ClipFacts, ContactsAreThoseOfFeetThatStand) {
    const ValidationGuard guard;
    const cage::Character wren = readCharacter(kWren);
    const SuppleAsset asset = own->createAsset(wren);
    const auto walk = static_cast<uint32_t>(clipNumber(wren, "walk"));
    uint32_t count = 0;
    ASSERT_EQ(suppleGetClipContacts(own->handle(), asset, walk, nullptr, &count), SUPPLE_OK);
    ASSERT_GT(count, 1u);
    std::vector<SuppleClipContact> contacts(count);
    ASSERT_EQ(suppleGetClipContacts(own->handle(), asset, walk, contacts.data(), &count), SUPPLE_OK);
    double last = 0.0;
    for (const SuppleClipContact& contact : contacts) {
        const uint32_t foot = wren.skin.joints[contact.joint];
        EXPECT_EQ(wren.skeleton.nodes[foot].name.substr(0, 4), "foot");
        EXPECT_GE(contact.begin, last);
        EXPECT_LE(contact.end, wren.clips[walk].duration);
        last = contact.begin;
        std::vector<glm::mat4> globals(wren.skeleton.nodes.size());
        for (const double part : {0.0, 0.5, 1.0}) {
            const double time = contact.begin + part * (contact.end - contact.begin);
            skinning::sampleClip(wren.skeleton, wren.clips[walk], time, globals);
            skinning::globalTransforms(wren.skeleton, globals, globals);
            const glm::vec3 place(globals[foot][3]);
            const auto held = [&](int axis) {
                return contact.position[axis] + contact.velocity[axis] * static_cast<float>(time - contact.begin);
            };
            EXPECT_LT(glm::length(glm::vec2(place.x - held(0), place.z - held(2))), 0.1f) << "legs are 0.9 long";
            EXPECT_GT(place.y, contact.position[1]);
        }
    }
    count = 1;
    EXPECT_EQ(suppleGetClipContacts(own->handle(), asset, walk, contacts.data(), &count), SUPPLE_INCOMPLETE);
    EXPECT_EQ(suppleGetClipContacts(own->handle(), tube, 0, nullptr, &count), SUPPLE_OK);
    EXPECT_EQ(count, 0u) << "a tube has no feet";

    SuppleClipInfo info{};
    info.structSize = sizeof(info);
    ASSERT_EQ(suppleGetClipInfo(own->handle(), asset, walk, &info), SUPPLE_OK);
    EXPECT_EQ(info.byteCount, skinning::clipBytes(skinning::nodeOrder(wren), wren.clips[walk]));
    EXPECT_EQ(info.packedError, 0.0);
}

TEST_F(ClipFacts, MarkersThatPlaybackPasses) {
    const ValidationGuard guard;
    EXPECT_EQ(between(0.0, 1.0, 0), (Times{{"right", 1.0}}));
    EXPECT_EQ(between(0.0, 1.0, SUPPLE_MARKERS_START), (Times{{"left", 0.0}, {"right", 1.0}}));
    EXPECT_EQ(between(1.5, 5.5, SUPPLE_MARKERS_LOOP),
              (Times{{"end", 2.0}, {"left", 2.0}, {"right", 3.0}, {"end", 4.0}, {"left", 4.0}, {"right", 5.0}}));
    EXPECT_EQ(between(2.5, 0.5, SUPPLE_MARKERS_LOOP), (Times{{"left", 2.0}, {"end", 2.0}, {"right", 1.0}}));
    EXPECT_EQ(between(0.0, 100.0, SUPPLE_MARKERS_LOOP, 2), (Times{{"right", 1.0}, {"end", 2.0}})) << "the first ones";
    uint32_t count = 0;
    EXPECT_EQ(suppleGetClipMarkersBetween(own->handle(), tube, 0, 0.0, 100.0, SUPPLE_MARKERS_LOOP, nullptr, &count),
              SUPPLE_OK);
    EXPECT_EQ(count, 150u);
}

/// What the device writes of a clip's poses lies in the box of the group, whatever its scheme and skinning.
TEST_F(ClipFacts, BoundsHoldTheSurface) {
    const ValidationGuard guard;
    const SuppleAsset pip = own->asset(kPip);
    for (const SuppleAsset asset : {tube, pip}) {
        for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_FRAGMENTS, SUPPLE_SCHEME_BLEND}) {
            for (const SuppleSkinning skinning : kSkinnings) {
                SuppleGroupDesc desc{};
                desc.asset = asset;
                desc.capacity = 16;
                desc.scheme = scheme;
                desc.rate = 2;
                desc.skinning = skinning;
                Crowd crowd(*own, desc);
                ASSERT_TRUE(crowd.valid());
                SuppleBounds box{}, cage{};
                EXPECT_EQ(suppleGetGroupClipBounds(own->handle(), crowd.group(), 0, &box), SUPPLE_OK);
                EXPECT_EQ(suppleGetClipBounds(own->handle(), asset, 0, &cage), SUPPLE_OK);
                SuppleClipInfo info{};
                info.structSize = sizeof(info);
                EXPECT_EQ(suppleGetClipInfo(own->handle(), asset, 0, &info), SUPPLE_OK);
                for (uint32_t i = 0; i < 16; ++i) {
                    crowd.pose(crowd.spawn(), 0, info.duration * i / 15.0, glm::mat4(1.0f));
                }
                crowd.run();
                for (uint32_t slot = 0; slot < 16; ++slot) {
                    for (const glm::vec3& p : asPositions(crowd.positions(slot))) {
                        for (int axis = 0; axis < 3; ++axis) {
                            ASSERT_GE(p[axis], box.min[axis]);
                            ASSERT_LE(p[axis], box.max[axis]);
                        }
                    }
                    const auto vertices = as<glm::vec4>(crowd.slotBytes(crowd.output().info.deformedCage, slot));
                    for (uint32_t v = 0; v < crowd.output().info.cageVertexCount; ++v) {
                        for (int axis = 0; axis < 3; ++axis) {
                            ASSERT_GE(vertices[v][axis], box.min[axis]);
                            ASSERT_LE(vertices[v][axis], box.max[axis]);
                            if (skinning == SUPPLE_SKINNING_LINEAR) {
                                ASSERT_GE(vertices[v][axis], cage.min[axis]);
                                ASSERT_LE(vertices[v][axis], cage.max[axis]);
                            }
                        }
                    }
                }
            }
        }
    }
}

TEST_F(ClipFacts, BoundsOfTheBindPoseAreTheAssets) {
    const ValidationGuard guard;
    SuppleAssetInfo info{};
    info.structSize = sizeof(info);
    ASSERT_EQ(suppleGetAssetInfo(own->handle(), tube, &info), SUPPLE_OK);
    SuppleBounds bind{}, again{}, rest{};
    EXPECT_EQ(suppleGetClipBounds(own->handle(), tube, SUPPLE_BIND_POSE, &bind), SUPPLE_OK);
    EXPECT_EQ(suppleGetClipBounds(own->handle(), tube, SUPPLE_BIND_POSE, &again), SUPPLE_OK);
    EXPECT_EQ(suppleGetClipBounds(own->handle(), tube, SUPPLE_REST_POSE, &rest), SUPPLE_OK);
    EXPECT_EQ(std::memcmp(&bind, &again, sizeof(bind)), 0);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(bind.min[axis], info.boundsMin[axis]);
        EXPECT_EQ(bind.max[axis], info.boundsMax[axis]);
        EXPECT_LE(rest.min[axis], bind.min[axis]) << "this character's rest pose is its bind pose";
        EXPECT_NEAR(rest.min[axis], bind.min[axis], 1e-3f);
        EXPECT_NEAR(rest.max[axis], bind.max[axis], 1e-3f);
    }
}

} // namespace
} // namespace supple::test
