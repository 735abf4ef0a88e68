// Groups whose poses or cages the host writes into their buffers, against groups that are posed by calls.
#include "cage/gltf/reader.h"
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sample_assets.h"

#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

using PoseSources = CrowdContexts;

/// A matrix of quarter turns, powers of two and eighths, so that products of a few are exact; it moves along every
/// axis.
glm::mat4 exactMatrix(Noise& noise) {
    const auto eighths = [&] { return std::floor(8.0f * noise()) / 8.0f + 0.0625f; };
    const auto axis = static_cast<int>(1.5f * (noise() + 1.0f)) % 3;
    const float size = noise() > 0.0f ? 1.0f : 0.5f;
    glm::mat4 m(0.0f);
    for (int c = 0; c < 3; ++c) {
        m[c][(c + axis) % 3] = size;
    }
    m[3] = {eighths(), eighths(), eighths(), 1.0f};
    return m;
}

/// A full group that calls pose, and one like it that the host fills.
struct Twins {
    Twins(CrowdContext& context, SuppleGroupDesc desc, SupplePoseSource source)
        : called(context, desc), filled(context, [&] {
              desc.poseSource = source;
              return desc;
          }()) {
        for (uint32_t i = 0; i < desc.capacity; ++i) {
            callers.push_back(called.spawn());
            fillers.push_back(filled.spawn());
        }
    }
    Crowd called, filled;
    std::vector<SuppleInstance> callers, fillers;
};

TEST_F(PoseSources, PalettesFromABufferPoseAsCallsDo) {
    const ValidationGuard guard;
    constexpr uint32_t kJoints = 4, kTargets = 5;
    const cage::Character tube = riggedTube({.joints = kJoints, .morphTargets = kTargets});
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        SuppleGroupDesc desc{};
        desc.asset = own.createAsset(tube);
        desc.capacity = 4;
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.rate = 2;
        desc.flags = SUPPLE_GROUP_MOTION;
        Twins twins(own, desc, SUPPLE_POSES_PALETTE_BUFFER);
        Crowd &called = twins.called, &filled = twins.filled;
        const std::vector<SuppleInstance>&callers = twins.callers, &fillers = twins.fillers;
        ASSERT_TRUE(called.valid() && filled.valid());
        const SuppleBufferRange poses = filled.output().info.poses;
        EXPECT_GE(poses.stride, (12 * kJoints + kTargets) * sizeof(float));
        EXPECT_EQ(poses.stride % 16, 0u);
        std::vector<PositionBits> past;
        for (uint32_t frame = 0; frame < 3; ++frame) {
            SCOPED_TRACE("frame " + std::to_string(frame));
            std::vector<float> bytes(poses.size / sizeof(float), 0.0f);
            for (uint32_t i = 0; i < desc.capacity; ++i) {
                Noise noise(100 * frame + i + 1);
                const glm::mat4 transform = exactMatrix(noise);
                std::vector<glm::mat4> joints;
                float* target = bytes.data() + i * poses.stride / sizeof(float);
                for (uint32_t j = 0; j < kJoints; ++j) {
                    joints.push_back(exactMatrix(noise));
                    const glm::mat4 whole = transform * joints[j] * tube.skin.inverseBinds[j];
                    for (int row = 0; row < 3; ++row) {
                        for (int column = 0; column < 4; ++column) {
                            *target++ = whole[column][row];
                        }
                    }
                }
                std::vector<float> weights;
                for (uint32_t t = 0; t < kTargets; ++t) {
                    weights.push_back(noise());
                    *target++ = weights.back();
                }
                EXPECT_EQ(suppleSetMatrixPose(own.handle(), callers[i], glm::value_ptr(joints[0]), kJoints), SUPPLE_OK);
                EXPECT_EQ(suppleSetMorphWeights(own.handle(), callers[i], weights.data(), kTargets), SUPPLE_OK);
                EXPECT_EQ(suppleSetTransform(own.handle(), callers[i], glm::value_ptr(transform)), SUPPLE_OK);
            }
            called.setVisible(callers[1], frame != 1);
            filled.setVisible(fillers[1], frame != 1);
            called.run();
            const std::vector<std::byte> calledPoses = called.read(called.output().info.poses);
            size_t different = 0;
            for (size_t i = 0; i < bytes.size(); ++i) { // as numbers: zeros have signs
                float value = 0.0f;
                std::memcpy(&value, calledPoses.data() + i * sizeof(float), sizeof(value));
                different += value != bytes[i] ? 1 : 0;
            }
            EXPECT_EQ(different, 0u) << "the layout is not as described";
            filled.run([&](VkCommandBuffer commands) {
                vkCmdUpdateBuffer(commands, poses.buffer, poses.offset, poses.size, bytes.data());
            });
            EXPECT_EQ(filled.listed(), called.listed());
            for (const uint32_t slot : filled.listed()) {
                EXPECT_EQ(differences(filled.positions(slot), called.positions(slot)), 0u) << "slot " << slot;
                EXPECT_EQ(differences(filled.previous(slot), called.previous(slot)), 0u) << "slot " << slot;
                if (frame > 0 && slot != 1) {
                    EXPECT_EQ(differences(filled.previous(slot), past[slot]), 0u) << "slot " << slot;
                    EXPECT_GT(differences(filled.positions(slot), past[slot]), 0u) << "slot " << slot;
                }
            }
            past.clear();
            for (uint32_t slot = 0; slot < desc.capacity; ++slot) {
                past.push_back(filled.positions(slot));
            }
        }
        // What the host does not write anew stands.
        filled.run();
        EXPECT_EQ(differences(filled.positions(3), past[3]), 0u);
        EXPECT_EQ(differences(filled.previous(3), past[3]), 0u);
    }
}

TEST_F(PoseSources, APaletteCopiedOnTheDevicePosesACharacter) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        SuppleGroupDesc desc{};
        desc.asset = own.asset(kPip);
        desc.capacity = 2;
        desc.rate = 2;
        desc.flags = SUPPLE_GROUP_MOTION;
        Crowd called(own, desc);
        desc.poseSource = SUPPLE_POSES_PALETTE_BUFFER;
        Crowd filled(own, desc);
        ASSERT_TRUE(called.valid() && filled.valid());
        const SuppleInstance first = called.spawn(), second = called.spawn();
        static_cast<void>(filled.spawn());
        static_cast<void>(filled.spawn());
        for (uint32_t frame = 0; frame < 2; ++frame) {
            called.pose(first, 0, 0.3 + frame, glm::mat4(1.0f));
            called.pose(second, 1, 0.6 + frame, glm::translate(glm::mat4(1.0f), {0.3f, 0.1f, 2.0f}));
            called.run();
            filled.run([&](VkCommandBuffer commands) {
                const SuppleBufferRange from = called.output().info.poses, to = filled.output().info.poses;
                const VkBufferCopy region{from.offset, to.offset, to.size};
                vkCmdCopyBuffer(commands, from.buffer, to.buffer, 1, &region);
            });
            for (uint32_t slot = 0; slot < 2; ++slot) {
                EXPECT_EQ(differences(filled.positions(slot), called.positions(slot)), 0u);
                EXPECT_EQ(differences(filled.previous(slot), called.previous(slot)), 0u);
            }
        }
    }
}

TEST_F(PoseSources, CagesFromABufferHaveTheSameSurface) {
    const ValidationGuard guard;
    const std::pair<SuppleMapping, SuppleScheme> cases[] = {
        {SUPPLE_MAPPING_NARROW, SUPPLE_SCHEME_PM},       {SUPPLE_MAPPING_NARROW, SUPPLE_SCHEME_FRAGMENTS},
        {SUPPLE_MAPPING_NARROW, SUPPLE_SCHEME_BLEND},    {SUPPLE_MAPPING_NARROW, SUPPLE_SCHEME_CATMULL_CLARK},
        {SUPPLE_MAPPING_NARROW, SUPPLE_SCHEME_POLYGONS}, {SUPPLE_MAPPING_WIDE, SUPPLE_SCHEME_PM}};
    for (const auto& [mapping, scheme] : cases) {
        SCOPED_TRACE(mappingName(mapping) + " scheme " + std::to_string(scheme));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        SuppleGroupDesc desc{};
        desc.asset = own.asset(kPip);
        desc.capacity = 3;
        desc.scheme = scheme;
        desc.rate = 4;
        desc.flags = SUPPLE_GROUP_MOTION;
        Twins twins(own, desc, SUPPLE_POSES_CAGE_BUFFER);
        Crowd &called = twins.called, &filled = twins.filled;
        const std::vector<SuppleInstance>&callers = twins.callers, &fillers = twins.fillers;
        ASSERT_TRUE(called.valid() && filled.valid());
        EXPECT_EQ(called.output().info.cageVerticesPerInstance, filled.output().info.cageVerticesPerInstance);
        EXPECT_EQ(filled.output().info.poses.buffer, VkBuffer{VK_NULL_HANDLE}) << "nothing would read them";
        for (uint32_t frame = 0; frame < 3; ++frame) {
            SCOPED_TRACE("frame " + std::to_string(frame));
            for (const SuppleInstance& instance : callers) {
                called.pose(instance, instance.slot, 0.2 + 0.4 * frame,
                            glm::translate(glm::mat4(1.0f), {0.5f * static_cast<float>(frame), 0.0f, 0.1f}));
            }
            called.setVisible(callers[0], frame != 1);
            filled.setVisible(fillers[0], frame != 1);
            called.run();
            const SuppleBufferRange to = filled.output().info.deformedCage;
            const std::vector<std::byte> cages = called.read(called.output().info.deformedCage);
            const Result<host::Buffer> staging = own.device().uploadBuffer(
                cages.data(), cages.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT); // a cloth solver's, say
            ASSERT_TRUE(staging.ok());
            filled.run([&](VkCommandBuffer commands) {
                const VkBufferCopy region{0, to.offset, to.size};
                vkCmdCopyBuffer(commands, staging->handle(), to.buffer, 1, &region);
            });
            EXPECT_TRUE(filled.read(to) == cages) << "the host's cage was written";
            EXPECT_EQ(filled.listed(), called.listed());
            for (const uint32_t slot : filled.listed()) {
                EXPECT_EQ(differences(filled.positions(slot), called.positions(slot)), 0u) << "slot " << slot;
                EXPECT_EQ(differences(filled.previous(slot), called.previous(slot)), 0u) << "slot " << slot;
                EXPECT_EQ(differences(filled.positions(slot), filled.previous(slot)) == 0,
                          frame == 0 || (slot == 0 && frame == 2))
                    << "slot " << slot;
            }
        }
    }
}

TEST_F(PoseSources, WhatIsLeftToTheHostIsRefused) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    for (const SupplePoseSource source : {SUPPLE_POSES_PALETTE_BUFFER, SUPPLE_POSES_CAGE_BUFFER}) {
        SuppleGroupDesc desc{};
        desc.asset = own.createAsset(riggedTube({.joints = 2, .morphTargets = 2}));
        desc.capacity = 1;
        desc.rate = 2;
        desc.poseSource = source;
        Crowd crowd(own, desc);
        ASSERT_TRUE(crowd.valid());
        const SuppleInstance instance = crowd.spawn();
        const glm::mat4 matrices[2] = {glm::mat4(1.0f), glm::mat4(1.0f)};
        const float weights[2] = {0.5f, 0.5f};
        SupplePoseDesc pose{};
        pose.structSize = sizeof(pose);
        const auto conflict = [&](SuppleResult result, const char* call) {
            EXPECT_EQ(result, SUPPLE_ERROR_ARGUMENT) << call;
            EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_CONFLICT) << call;
        };
        SuppleContext handle = own.handle();
        conflict(suppleSetClipPose(handle, instance, SUPPLE_BIND_POSE, 0.0), "suppleSetClipPose");
        conflict(suppleSetClipPose(handle, instance, SUPPLE_REST_POSE, 0.0), "suppleSetClipPose");
        conflict(suppleSetPose(handle, instance, &pose), "suppleSetPose");
        conflict(suppleSetMatrixPose(handle, instance, glm::value_ptr(matrices[0]), 2), "suppleSetMatrixPose");
        conflict(suppleSetMorphWeights(handle, instance, weights, 2), "suppleSetMorphWeights");
        conflict(suppleSetMorphWeights(handle, instance, nullptr, 0), "suppleSetMorphWeights");
        conflict(suppleSetTransform(handle, instance, glm::value_ptr(matrices[0])), "suppleSetTransform");
        crowd.setVisible(instance, false);
        crowd.setVisible(instance, true);
        crowd.teleport(instance);
        crowd.destroy(instance);
        EXPECT_EQ(suppleSetTransform(handle, instance, glm::value_ptr(matrices[0])), SUPPLE_ERROR_ARGUMENT);
        EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_STALE_HANDLE);

        desc.structSize = sizeof(desc);
        desc.skinning = SUPPLE_SKINNING_DUAL_QUATERNION;
        SuppleGroup group{};
        const SuppleResult result = suppleCreateGroup(handle, &desc, &group);
        if (source == SUPPLE_POSES_PALETTE_BUFFER) {
            conflict(result, "suppleCreateGroup");
            EXPECT_EQ(group.id, 0u);
        } else {
            EXPECT_EQ(result, SUPPLE_OK) << "a cage says nothing about skinning";
            EXPECT_EQ(suppleDestroyGroup(handle, group), SUPPLE_OK);
        }
        desc.skinning = SUPPLE_SKINNING_LINEAR;
        desc.poseSource = static_cast<SupplePoseSource>(4);
        EXPECT_EQ(suppleCreateGroup(handle, &desc, &group), SUPPLE_ERROR_ARGUMENT);
        EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_OUT_OF_RANGE);
    }
}

TEST_F(PoseSources, GroupsWithoutASurfaceTakeThemToo) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    for (const SupplePoseSource source : {SUPPLE_POSES_PALETTE_BUFFER, SUPPLE_POSES_CAGE_BUFFER}) {
        SuppleGroupDesc desc{};
        const cage::Character tube = riggedTube({.joints = 1});
        desc.asset = own.createAsset(tube);
        desc.capacity = 1;
        desc.scheme = SUPPLE_SCHEME_CAGE;
        desc.poseSource = source;
        desc.flags = SUPPLE_GROUP_MOTION; // of nothing
        Crowd crowd(own, desc);
        ASSERT_TRUE(crowd.valid());
        static_cast<void>(crowd.spawn());
        const host::GroupOutput output = crowd.output();
        EXPECT_EQ(output.streams.previousPositions.buffer, VkBuffer{VK_NULL_HANDLE});
        const float rows[12] = {2, 0, 0, 1, 0, 2, 0, 0, 0, 0, 2, 0};
        const float point[4] = {1, 2, 3, 1};
        crowd.run([&](VkCommandBuffer commands) {
            if (source == SUPPLE_POSES_PALETTE_BUFFER) {
                vkCmdUpdateBuffer(commands, output.info.poses.buffer, output.info.poses.offset, sizeof(rows), rows);
            } else {
                vkCmdUpdateBuffer(commands, output.info.deformedCage.buffer, output.info.deformedCage.offset,
                                  sizeof(point), point);
            }
        });
        const std::vector<std::byte> bytes = crowd.read(output.info.deformedCage);
        glm::vec3 first{};
        std::memcpy(&first, bytes.data(), sizeof(first));
        const glm::vec3 wanted = source == SUPPLE_POSES_PALETTE_BUFFER
                                     ? 2.0f * tube.cage.positions[0] + glm::vec3(1.0f, 0.0f, 0.0f)
                                     : glm::vec3(1.0f, 2.0f, 3.0f);
        EXPECT_LT(glm::length(first - wanted), 1e-5f);
    }
}

} // namespace
} // namespace supple::test
