// The device's arithmetic of poses, on the CPU: against doubles, and against numbers that must never change. That
// devices have the very same bits is tested in tests/runtime/playback_test.cpp.
#include "shaders/pose/affine.h"
#include "skinning/joints.h"
#include "skinning/played_pose.h"
#include "skinning/pose_twin.h"
#include "skinning/rotation.h"
#include "tests/support/rigged_tube.h"

#include <bit>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

namespace supple::skinning {
namespace {

using test::Noise;

glm::vec4 asVector(const glm::dquat& q) {
    return glm::vec4(glm::dvec4(q.x, q.y, q.z, q.w));
}
glm::dquat asRotation(const glm::vec4& q) {
    return {static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z)};
}
/// The angle between two rotations of any length.
double angleBetween(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat d = glm::conjugate(unit(a)) * unit(b);
    return 2.0 * std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), std::abs(d.w));
}

TEST(PoseArithmetic, QuotientsAndRootsAreGoodToTheLastBit) {
    Noise noise(4);
    double quotients = 0.0, roots = 0.0, wide = 0.0;
    for (int i = 0; i < 200000; ++i) {
        const float x = std::ldexp(1.0f + std::abs(noise()), static_cast<int>(99.0f * noise()));
        const double exact = static_cast<double>(x);
        quotients = std::max(quotients, std::abs(static_cast<double>(shared::recip(x)) * exact - 1.0));
        roots = std::max(roots, std::abs(static_cast<double>(shared::rsqrt(x)) * std::sqrt(exact) - 1.0));
        const float y = std::ldexp(noise() < 0.0f ? -1.5f : 1.25f, static_cast<int>(125.0f * noise()));
        wide = std::max(wide, std::abs(static_cast<double>(shared::wideRecip(y)) * static_cast<double>(y) - 1.0));
        const float down = x * shared::broughtDown(x);
        ASSERT_TRUE(down >= 1.0f && down < 2.0f) << x;
    }
    std::printf("in units of 2^-24: quotients %.3f, of any size %.3f, roots %.3f\n", quotients * 0x1p24, wide * 0x1p24,
                roots * 0x1p24);
    EXPECT_LT(quotients, 1.5 * 0x1p-24);
    EXPECT_LT(wide, 1.5 * 0x1p-24);
    EXPECT_LT(roots, 1.7 * 0x1p-24);
}

TEST(PoseArithmetic, SlerpIsThatOfDoubles) {
    Noise noise(5);
    double worst = 0.0, worstTimes = 0.0;
    for (int i = 0; i < 100000; ++i) {
        const glm::dquat a = unit({noise(), noise(), noise(), noise()});
        glm::dquat b = unit({noise(), noise(), noise(), noise()});
        if (i % 4 == 0) { // close to each other, also by the other sign
            b = unit(a + b * static_cast<double>(0.01f * noise())) * (i % 8 == 0 ? -1.0 : 1.0);
        }
        if (std::abs(glm::dot(a, b)) < 1e-3) {
            continue; // either way is as short
        }
        const float t = 0.5f + 0.5f * noise();
        const glm::dquat exact = slerp(a, b, static_cast<double>(t));
        worst = std::max(worst, angleBetween(exact, asRotation(shared::slerp(asVector(a), asVector(b), t))));
        const float times = 3.0f * noise();
        const glm::dquat often = slerp({1.0, 0.0, 0.0, 0.0}, b, static_cast<double>(times));
        worstTimes = std::max(worstTimes, angleBetween(often, asRotation(shared::turnedTimes(asVector(b), times))));
    }
    std::printf("slerp: off by at most %.2g rad; a turn up to three times over: %.2g rad\n", worst, worstTimes);
    EXPECT_LT(worst, 2e-6);
    EXPECT_LT(worstTimes, 4e-6);
    const glm::vec4 q(0.5f, -0.5f, 0.5f, 0.5f), none(0.0f);
    EXPECT_EQ(shared::slerp(q, -q, 0.25f), q) << "the very same rotation stays";
    EXPECT_EQ(shared::unit(none), shared::noTurn());
    EXPECT_EQ(shared::slerp(none, none, 0.3f), none);
}

TEST(PoseArithmetic, NearestRotationIsThatOfDoubles) {
    Noise noise(6);
    double even = 0.0, any = 0.0, mirrored = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dquat q = unit({noise(), noise(), noise(), noise()});
        const float size = std::exp(8.0f * noise());
        const auto rotationOf = [](const glm::mat3& m) { return shared::nearestRotation(m[0], m[1], m[2]); };
        const glm::mat3 evenly(glm::mat3_cast(q) * static_cast<double>(size));
        even = std::max(even, angleBetween(q, asRotation(rotationOf(evenly))));
        mirrored = std::max(mirrored, angleBetween(q, asRotation(rotationOf(-evenly))));
        const glm::dquat axes = unit({noise(), noise(), noise(), noise()});
        const glm::dmat3 turn = glm::mat3_cast(axes);
        glm::dmat3 stretched = glm::transpose(turn);
        for (int row = 0; row < 3; ++row) {
            const double factor = 0.55 + 0.45 * static_cast<double>(noise());
            for (int column = 0; column < 3; ++column) {
                stretched[column][row] *= factor * static_cast<double>(size);
            }
        }
        const glm::mat3 sheared(glm::mat3_cast(q) * (turn * stretched));
        any = std::max(any, angleBetween(nearestRotation(glm::dmat3(sheared)), asRotation(rotationOf(sheared))));
    }
    std::printf("nearest rotation: off by at most %.2g rad if scaled evenly, %.2g mirrored, %.2g sheared\n", even,
                mirrored, any);
    EXPECT_LT(even, 2e-6);
    EXPECT_LT(mirrored, 2e-6);
    EXPECT_LT(any, 2e-5);
    // Where a matrix flattens there still is one; of nothing, none.
    const glm::vec4 flat = shared::nearestRotation({1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, glm::vec3(0.0f));
    EXPECT_LT(angleBetween({1.0, 0.0, 0.0, 0.0}, asRotation(flat)), 1e-6);
    EXPECT_EQ(shared::nearestRotation(glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(0.0f)), shared::noTurn());
}

/// The words, as a number: FNV-1a.
uint64_t hashOf(std::span<const glm::vec4> values) {
    uint64_t hash = 0xCBF29CE484222325u;
    for (const glm::vec4& value : values) {
        for (int i = 0; i < 4; ++i) {
            for (uint32_t word = std::bit_cast<uint32_t>(value[i]), k = 0; k < 4; ++k, word >>= 8) {
                hash = (hash ^ (word & 255u)) * 0x100000001B3u;
            }
        }
    }
    return hash;
}

class PoseTwinOf : public testing::TestWithParam<SkinningMode> {};

TEST_P(PoseTwinOf, ATubeHasTheBitsItHasEverywhere) {
    cage::Character tube = test::riggedTube({.segments = 4, .sides = 4, .joints = 3});
    tube.clips.push_back(
        test::clipOf({test::channel(1, cage::ChannelPath::translation, {0, 1, 2}, {0, 0, 0, 1, 0.5f, 0, 2, 0, 0.25f}),
                      test::channel(2, cage::ChannelPath::rotation, {0, 2}, {0, 0, 0, 1, 0, 0.6f, 0, 0.8f}),
                      test::channel(3, cage::ChannelPath::rotation, {0, 1.5f}, {0, 0, 0, 1, 0.8f, 0, 0.6f, 0}),
                      test::channel(3, cage::ChannelPath::scale, {0, 1.5f}, {1, 1, 1, 2, 1, 0.5f})}));
    const Rig rig = makeRig(tube);
    const ClipTable table = buildClipTable(tube);
    const PoseLayout layout = PoseLayout::of(GetParam(), 3, 0);
    PlaybackLayer layers[3];
    layers[0] = {.clip = 0, .loop = true, .speed = 0.7f};
    layers[1] = {.clip = 0, .weight = 0.3f, .fadeWeight = 0.9f, .fadeStart = 4.0, .fadeDuration = 3.0f, .offset = 0.4};
    layers[2] = {.clip = 0, .mode = LayerMode::additive, .weight = -0.6f, .offset = 1.1, .speed = 0.1f};
    const PlaybackDesc desc{layers, {1, kRootGround | kRootYaw}, true};
    std::vector<uint32_t> words(4 * size_t{PlaybackState::elements(0)});
    PlaybackState state(words);
    state.setTransform(glm::translate(glm::mat4(1.0f), {1.0f, 2.0f, 3.0f}));
    state.set(tube, table, desc);
    PoseTwin twin(table, layout, 0);
    twin.pose(words, {}, 5.3);

    PoseMemory memory(tube);
    poseNodes(tube, rig, desc, 5.3, {}, memory);
    const glm::dmat4 place = glm::dmat4(state.transform()) * toMatrix(traveledBy(tube, desc, 5.3));
    for (uint32_t j = 0; j < 3; ++j) {
        const glm::mat4 wanted = memory.nodes[tube.skin.joints[j]], placed(place * glm::dmat4(wanted));
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                EXPECT_NEAR(twin.joint(j)[column][row], wanted[column][row], 2e-5);
                EXPECT_NEAR(twin.placedJoint(j)[column][row], placed[column][row], 2e-5);
            }
        }
    }
    std::vector<glm::vec4> pose(layout.stride);
    twin.write(pose);
    // The hash of the words. If it changes, poses are no longer those of recordings made before: say so in the
    // changelog.
    const uint64_t wanted = GetParam() == SkinningMode::linear ? 0xB247B47D108D2A54u : 0x2414174A8D720ED8u;
    EXPECT_EQ(hashOf(pose), wanted) << std::hex << hashOf(pose);
}

INSTANTIATE_TEST_SUITE_P(PoseTwin, PoseTwinOf, testing::Values(SkinningMode::linear, SkinningMode::dualQuaternion));

} // namespace
} // namespace supple::skinning
