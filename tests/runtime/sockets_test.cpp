// Where joints are (suppleGetJointTransform, SuppleJointInfo), and a prop that a character holds. That the CPU and the
// device agree on all that plays is tested in playback_test.cpp.
#include "tests/support/allocation_count.h"
#include "tests/support/crowd.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sample_assets.h"

#include <array>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>
#include <supple/supple.hpp>

namespace supple::test {
namespace {

constexpr SupplePoseSource kKnown[] = {SUPPLE_POSES_SET, SUPPLE_POSES_PLAYBACK};

using Matrix = std::array<float, 16>;

Matrix arrayOf(const glm::mat4& matrix) {
    Matrix result;
    std::memcpy(result.data(), &matrix, sizeof(matrix));
    return result;
}

SuppleGroupDesc socketGroup(SuppleAsset asset, uint32_t capacity, SupplePoseSource source = SUPPLE_POSES_SET) {
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = capacity;
    desc.scheme = SUPPLE_SCHEME_CAGE;
    desc.poseSource = source;
    return desc;
}

SupplePlaybackLayer layerOf(uint32_t clip, double offset = 0.0) {
    SupplePlaybackLayer layer{};
    layer.clip = clip;
    layer.flags = SUPPLE_LAYER_LOOP;
    layer.weight = layer.speed = 1.0f;
    layer.offset = offset;
    return layer;
}

/// A tube whose second joint turns and whose first walks.
cage::Character socketTube() {
    cage::Character tube = riggedTube({.segments = 6, .sides = 6, .joints = 3});
    tube.skeleton.nodes[2].rotation = glm::angleAxis(0.3f, glm::vec3(0.0f, 0.0f, 1.0f)); // rest is not bind
    tube.clips.push_back(
        clipOf({channel(1, cage::ChannelPath::translation, {0, 1, 2}, {0, 0, 0, 1, 0.5f, 0, 2, 0, 0.25f}),
                channel(2, cage::ChannelPath::rotation, {0, 2}, {0, 0, 0, 1, 0, 0.6f, 0, 0.8f})}));
    tube.clips[0].name = "walk";
    return tube;
}

class Sockets : public CrowdContexts {
protected:
    void SetUp() override {
        CrowdContexts::SetUp();
        if (!HasFatalFailure()) {
            own = &context(SUPPLE_MAPPING_AUTO);
            ASSERT_TRUE(own->valid());
        }
    }
    [[nodiscard]] SuppleContext handle() const { return own->handle(); }
    [[nodiscard]] Matrix socket(SuppleInstance instance, uint32_t joint) const {
        Matrix result{};
        EXPECT_EQ(suppleGetJointTransform(handle(), instance, joint, result.data()), SUPPLE_OK);
        return result;
    }
    [[nodiscard]] SuppleJointInfo jointInfo(SuppleAsset asset, uint32_t joint) const {
        auto info = sized<SuppleJointInfo>();
        EXPECT_EQ(suppleGetJointInfo(handle(), asset, joint, &info), SUPPLE_OK);
        return info;
    }
    [[nodiscard]] uint32_t jointCount(SuppleAsset asset) const {
        auto info = sized<SuppleAssetInfo>();
        EXPECT_EQ(suppleGetAssetInfo(handle(), asset, &info), SUPPLE_OK);
        return info.jointCount;
    }
    void place(SuppleInstance instance, const glm::mat4& transform) const {
        EXPECT_EQ(suppleSetTransform(handle(), instance, glm::value_ptr(transform)), SUPPLE_OK);
    }
    void play(SuppleInstance instance, std::span<const SupplePlaybackLayer> layers, uint32_t rootMotion = 0,
              uint32_t flags = 0) const {
        auto desc = sized<SupplePlaybackDesc>();
        desc.layers = layers.data();
        desc.layerCount = static_cast<uint32_t>(layers.size());
        desc.rootMotion = rootMotion;
        desc.flags = flags;
        EXPECT_EQ(suppleSetPlayback(handle(), instance, &desc), SUPPLE_OK);
    }
    void setMask(SuppleGroup group, std::span<const float> joints) const {
        auto desc = sized<SuppleMaskDesc>();
        desc.mask = 1;
        desc.jointMask = joints.data();
        desc.jointMaskCount = static_cast<uint32_t>(joints.size());
        EXPECT_EQ(suppleSetMask(handle(), group, &desc), SUPPLE_OK);
    }

    CrowdContext* own = nullptr;
};

TEST_F(Sockets, MatrixPosesComeBackBitForBit) {
    const SuppleAsset asset = own->asset(kPip);
    const uint32_t joints = jointCount(asset);
    Crowd crowd(*own, socketGroup(asset, 2));
    ASSERT_TRUE(crowd.valid());
    const SuppleInstance first = crowd.spawn(), second = crowd.spawn();
    Noise noise(7);
    std::vector<float> matrices;
    for (uint32_t i = 0; i < 16 * joints; ++i) {
        matrices.push_back(i % 5 == 0 ? -0.0f : 3.0f * noise());
    }
    ASSERT_EQ(suppleSetMatrixPose(handle(), first, matrices.data(), joints), SUPPLE_OK);
    ASSERT_EQ(suppleSetMatrixPose(handle(), second, matrices.data(), joints), SUPPLE_OK);
    const glm::mat4 away = glm::rotate(glm::translate(glm::mat4(1.0f), {1.0f, -2.0f, 3.0f}), 0.7f, {0, 1, 0});
    place(second, away);
    for (uint32_t j = 0; j < joints; ++j) {
        const Matrix got = socket(first, j), placed = socket(second, j);
        EXPECT_EQ(std::memcmp(got.data(), matrices.data() + 16 * j, sizeof(got)), 0) << "joint " << j;
        const glm::mat4 wanted(glm::dmat4(away) * glm::dmat4(glm::make_mat4(matrices.data() + 16 * j)));
        EXPECT_EQ(placed, arrayOf(wanted)) << "joint " << j;
    }
}

TEST_F(Sockets, BindAndRestPosesAreThoseOfTheJointInfo) {
    for (const bool pip : {true, false}) {
        const SuppleAsset asset = pip ? own->asset(kPip) : own->createAsset(socketTube());
        const uint32_t joints = jointCount(asset);
        bool different = false;
        for (const SupplePoseSource source : kKnown) {
            Crowd crowd(*own, socketGroup(asset, 2, source));
            ASSERT_TRUE(crowd.valid());
            const SuppleInstance bound = crowd.spawn(), rests = crowd.spawn();
            if (source == SUPPLE_POSES_SET) {
                ASSERT_EQ(suppleSetClipPose(handle(), rests, SUPPLE_REST_POSE, 0.0), SUPPLE_OK);
            } else {
                play(rests, {});
            }
            for (uint32_t j = 0; j < joints; ++j) {
                const SuppleJointInfo info = jointInfo(asset, j);
                EXPECT_EQ(info.bindIsSingular, 0u);
                EXPECT_EQ(socket(bound, j), std::to_array(info.bindTransform)) << "joint " << j;
                // The device's arithmetic has another last bit than the reader's doubles.
                const Matrix at = socket(rests, j);
                for (size_t k = 0; k < at.size(); ++k) {
                    EXPECT_NEAR(at[k], info.restTransform[k], source == SUPPLE_POSES_SET ? 0.0f : 1e-6f)
                        << "joint " << j;
                }
                different = different || std::memcmp(info.bindTransform, info.restTransform, sizeof(Matrix)) != 0;
            }
        }
        EXPECT_TRUE(pip || different) << "the two are not the same thing";
    }
}

TEST_F(Sockets, ASingularInverseBindGivesTheRestTransform) {
    cage::Character tube = socketTube();
    tube.skin.inverseBinds[0] = glm::scale(glm::mat4(1.0f), {1.0f, 0.0f, 1.0f});
    tube.skin.inverseBinds[1] = glm::scale(glm::mat4(1.0f), {1e-30f, 1e-30f, 1e-30f}); // whose inverse is far beyond
    tube.skin.inverseBinds[1][3] = glm::vec4(1e9f, 0.0f, 0.0f, 1.0f);                  // what floats hold
    const SuppleAsset asset = own->createAsset(tube);
    for (uint32_t j = 0; j < 3; ++j) {
        const SuppleJointInfo info = jointInfo(asset, j);
        EXPECT_EQ(info.bindIsSingular, j < 2 ? 1u : 0u);
        EXPECT_EQ(std::memcmp(info.bindTransform, info.restTransform, sizeof(Matrix)) == 0, j < 2);
        for (const SupplePoseSource source : kKnown) {
            Crowd crowd(*own, socketGroup(asset, 1, source));
            ASSERT_TRUE(crowd.valid());
            EXPECT_EQ(socket(crowd.spawn(), j), std::to_array(info.bindTransform));
        }
    }
}

TEST_F(Sockets, AnOlderJointInfoIsNotWrittenBeyondItsEnd) {
    auto info = sized<SuppleJointInfo>();
    std::memset(info.restTransform, 0x5A, sizeof(info.restTransform) + sizeof(info.bindTransform));
    const auto before = std::to_array(info.restTransform);
    info.structSize = offsetof(SuppleJointInfo, restTransform);
    ASSERT_EQ(suppleGetJointInfo(handle(), own->asset(kPip), 1, &info), SUPPLE_OK);
    EXPECT_NE(info.name, nullptr);
    EXPECT_EQ(std::memcmp(info.restTransform, before.data(), sizeof(before)), 0);
}

// What is kept between calls must never show: a group that was asked after every change answers as one that is asked
// once.
TEST_F(Sockets, FollowWhatIsSet) {
    for (const size_t last : {0u, 1u}) { // whose pose is kept while things change
        const SuppleAsset asset = own->createAsset(socketTube());
        const auto make = [&] { return std::make_unique<Crowd>(*own, socketGroup(asset, 2, SUPPLE_POSES_PLAYBACK)); };
        const auto asked = make();
        std::vector<SuppleInstance> instances = {asked->spawn(), asked->spawn()};
        const std::vector<float> half = {1.0f, 0.5f, 0.25f}, ones(3, 1.0f);
        std::vector<SupplePlaybackLayer> masked = {layerOf(0, 0.2), layerOf(0, 1.1)};
        masked[1].mask = 1;
        masked[1].weight = 0.6f;
        struct State {
            SuppleGroup group;
            std::vector<SuppleInstance>& instances;
        };
        using Change = std::function<void(const State&)>;
        const std::vector<Change> changes = {
            [&](const State& s) { setMask(s.group, half); },
            [&](const State& s) { play(s.instances[0], masked); },
            [&](const State& s) { EXPECT_EQ(suppleSetTime(handle(), s.group, 0.7), SUPPLE_OK); },
            [&](const State& s) {
                play(s.instances[1], {masked.data(), 1});
            },
            [&](const State& s) { setMask(s.group, ones); },
            [&](const State& s) {
                place(s.instances[0], glm::translate(glm::mat4(1.0f), {4, 0, 0}));
            },
            [&](const State& s) { EXPECT_EQ(suppleSetVisible(handle(), s.instances[0], 0), SUPPLE_OK); },
            [&](const State& s) {
                play(s.instances[0], masked, SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW,
                     SUPPLE_PLAYBACK_TRAVEL);
            },
            [&](const State& s) { EXPECT_EQ(suppleSetTime(handle(), s.group, 1e6 + 0.3), SUPPLE_OK); },
            [&](const State& s) {
                EXPECT_EQ(suppleDestroyInstance(handle(), s.instances[0]), SUPPLE_OK);
                EXPECT_EQ(suppleCreateInstance(handle(), s.group, s.instances.data()), SUPPLE_OK);
            },
        };
        std::vector<Matrix> past;
        for (size_t n = 0; n < changes.size(); ++n) {
            SCOPED_TRACE("change " + std::to_string(n));
            changes[n]({asked->group(), instances});
            const auto fresh = make();
            std::vector<SuppleInstance> others = {fresh->spawn(), fresh->spawn()};
            for (size_t i = 0; i <= n; ++i) {
                changes[i]({fresh->group(), others});
            }
            std::vector<Matrix> now;
            for (uint32_t j = 0; j < 3; ++j) {
                for (const size_t i : {last, 1 - last}) {
                    now.push_back(socket(instances[i], j));
                    EXPECT_EQ(now.back(), socket(others[i], j)) << "instance " << i << ", joint " << j;
                }
                EXPECT_EQ(socket(instances[last], j), now[now.size() - 2]) << "asked again";
            }
            const bool shows = n > 0 && n != 6; // no layer has the mask yet; hiding moves nothing
            EXPECT_EQ(now != past, shows || n == 0);
            past = now;
        }
    }
}

TEST_F(Sockets, BuffersOfTheHostsAreUnknown) {
    const SuppleAsset asset = own->asset(kPip);
    for (const SupplePoseSource source : {SUPPLE_POSES_PALETTE_BUFFER, SUPPLE_POSES_CAGE_BUFFER}) {
        Crowd crowd(*own, socketGroup(asset, 1, source));
        ASSERT_TRUE(crowd.valid());
        const SuppleInstance instance = crowd.spawn();
        static_cast<void>(own->takeLines());
        Matrix out;
        out.fill(7.0f);
        const Matrix before = out;
        EXPECT_EQ(suppleGetJointTransform(handle(), instance, 0, out.data()), SUPPLE_ERROR_ARGUMENT);
        EXPECT_EQ(out, before);
        const std::vector<LogLine> lines = own->takeLines();
        ASSERT_EQ(lines.size(), 1u);
        EXPECT_EQ(lines[0].message, SUPPLE_MESSAGE_CONFLICT);
        EXPECT_NE(lines[0].text.find("a buffer that the host fills"), std::string::npos) << lines[0].text;
    }
}

TEST_F(Sockets, AskingAllocatesNothing) {
    const SuppleAsset asset = own->asset(kPip);
    const uint32_t joints = jointCount(asset);
    Crowd told(*own, socketGroup(asset, 2)), plays(*own, socketGroup(asset, 2, SUPPLE_POSES_PLAYBACK));
    ASSERT_TRUE(told.valid() && plays.valid());
    const SuppleInstance instances[] = {told.spawn(), told.spawn(), plays.spawn(), plays.spawn()};
    std::vector<SupplePlaybackLayer> layers = {layerOf(0), layerOf(1, 0.3)};
    layers[1].mode = SUPPLE_LAYER_ADDITIVE;
    layers[1].mask = 1;
    setMask(plays.group(), std::vector<float>(joints, 0.5f));
    play(instances[2], layers, SUPPLE_ROOT_MOTION_GROUND, SUPPLE_PLAYBACK_TRAVEL);
    play(instances[3], layers, SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW);
    bool good = true;
    const uint64_t before = allocationsCounted();
    for (int i = 0; i < 20; ++i) {
        const AllocationCount count;
        good = good && suppleSetTime(handle(), plays.group(), 0.1 * i) == SUPPLE_OK;
        for (const SuppleInstance& instance : instances) {
            float transform[16];
            good = good && suppleGetJointTransform(handle(), instance, joints / 2, transform) == SUPPLE_OK;
        }
    }
    EXPECT_TRUE(good);
    EXPECT_EQ(allocationsCounted(), before);
}

} // namespace
} // namespace supple::test
