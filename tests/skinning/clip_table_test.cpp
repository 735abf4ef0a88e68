// The tables of the pose pass: which nodes are in them and in what order, what they share, and masks by node.
#include "skinning/clip_table.h"

#include "shaders/shared/pose.h"
#include "skinning/playback.h"
#include "tests/support/rigged_tube.h"

#include <algorithm>
#include <bit>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

using namespace shared;
using skinning::ClipTable;

std::array<uint32_t, 4> element(const ClipTable& table, uint32_t index) {
    std::array<uint32_t, 4> words{};
    std::copy_n(table.words.begin() + static_cast<ptrdiff_t>(4 * size_t{index}), 4, words.begin());
    return words;
}

/// The tube's chain of joints, with a camera on the last one and a second chain of one joint beside it.
cage::Character branched() {
    cage::Character tube = riggedTube({.joints = 3, .morphTargets = 2});
    cage::Skeleton& skeleton = tube.skeleton;
    const auto add = [&](uint32_t parent) {
        cage::Node node;
        node.parent = parent;
        skeleton.nodes.push_back(node);
        skeleton.parentsFirst.push_back(static_cast<uint32_t>(skeleton.nodes.size() - 1));
        return static_cast<uint32_t>(skeleton.nodes.size() - 1);
    };
    add(3);
    tube.skin.joints.push_back(add(0));
    tube.skin.inverseBinds.emplace_back(1.0f);
    return tube;
}

TEST(ClipTable, HoldsWhatMovesJointsByDepth) {
    const ClipTable table = skinning::buildClipTable(branched());
    EXPECT_EQ(table.nodes, (std::vector<uint32_t>{0, 1, 5, 2, 3})) << "without the camera";
    EXPECT_EQ(table.places[4], cage::kNone);
    for (uint32_t place = 0; place < table.nodes.size(); ++place) {
        EXPECT_EQ(table.places[table.nodes[place]], place);
        const uint32_t parent = element(table, kNodeElements * place)[0];
        EXPECT_TRUE(place == 0 ? parent == kNoNode : parent < place);
    }
    const uint32_t ends[] = {1, 3, 4, 5};
    ASSERT_EQ(table.levelCount, 4u);
    for (uint32_t level = 0; level < 4; ++level) {
        EXPECT_EQ(element(table, table.levels + level)[0], level == 0 ? 0 : ends[level - 1]);
        EXPECT_EQ(element(table, table.levels + level)[1], ends[level]);
    }
    EXPECT_EQ(table.jointCount, 4u);
    EXPECT_EQ(element(table, table.joints + 3 * kJointElements + 3)[0], 2u) << "node 5 is the third";
}

TEST(ClipTable, ChannelsShareTheirTimes) {
    cage::Character tube = branched();
    const std::vector<float> times = {0.0f, 0.5f, 1.0f};
    const std::vector<float> places(9, 1.0f), turns = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    tube.clips.push_back(clipOf({channel(1, cage::ChannelPath::translation, times, places),
                                 channel(2, cage::ChannelPath::rotation, times, turns),
                                 channel(4, cage::ChannelPath::rotation, times, turns)}));
    const ClipTable table = skinning::buildClipTable(tube);
    const uint32_t nodes = element(table, table.clips)[0];
    EXPECT_EQ(std::bit_cast<float>(element(table, table.clips)[2]), 1.0f);
    const std::array<uint32_t, 4> first = element(table, nodes + table.places[1]),
                                  second = element(table, nodes + table.places[2]);
    EXPECT_NE(first[0], 0u);
    EXPECT_EQ(first[1] + first[2] + second[0] + second[2], 0u);
    const std::array<uint32_t, 4> moved = element(table, first[0]), turned = element(table, second[1]);
    EXPECT_EQ(moved[0], 4u * 3u + kLinearKeys);
    EXPECT_EQ(std::bit_cast<float>(moved[1]), 2.0f) << "keys a second";
    EXPECT_EQ(moved[2], turned[2]);
    EXPECT_NE(moved[3], turned[3]);
}

TEST(ClipTable, MasksAreOfNodes) {
    const cage::Character tube = branched();
    const ClipTable table = skinning::buildClipTable(tube);
    const skinning::Rig rig = skinning::makeRig(tube);
    ASSERT_EQ(skinning::maskElements(table), 3u);
    std::vector<float> values(12, -1.0f);
    const std::vector<float> joints = {0.25f, 0.5f, 0.75f, 1.0f}, morphs = {0.1f, 0.2f};
    skinning::writeMask(table, rig, joints, {}, values);
    // Node 0 is no joint: it follows the first joint below. Targets follow no joint.
    EXPECT_EQ(values, (std::vector<float>{0.25f, 0.25f, 1.0f, 0.5f, 0.75f, -1, -1, -1, 0, 0, -1, -1}));
    skinning::writeMask(table, rig, {}, morphs, values);
    EXPECT_EQ(values, (std::vector<float>{1, 1, 1, 1, 1, -1, -1, -1, 0.1f, 0.2f, -1, -1}));
}

} // namespace
} // namespace supple::test
