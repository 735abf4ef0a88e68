// A group whose instances play on the device, beside what the CPU says of them.
#pragma once

#include "runtime/api/entry.h"
#include "skinning/deform_twin.h"
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/skinnings.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>
#include <span>
#include <string>
#include <vector>

namespace supple::test {

/// A group of cages alone, whose instances play.
inline SuppleGroupDesc playedGroup(SuppleAsset asset, uint32_t capacity, uint32_t flags,
                                   SuppleSkinning skinning = SUPPLE_SKINNING_LINEAR) {
    SuppleGroupDesc desc{};
    desc.flags = flags;
    desc.asset = asset;
    desc.capacity = capacity;
    desc.scheme = SUPPLE_SCHEME_CAGE;
    desc.skinning = skinning;
    desc.poseSource = SUPPLE_POSES_PLAYBACK;
    return desc;
}

/// A group whose instances play. Its poses and cages are compared with the CPU's.
class PlayedGroup {
public:
    PlayedGroup(CrowdContext& context, const SuppleGroupDesc& desc) : crowd(context, desc) {
        for (uint32_t i = 0; crowd.valid() && i < desc.capacity; ++i) {
            instances.push_back(crowd.spawn());
        }
    }

    [[nodiscard]] SuppleContext handle() const { return crowd.context().handle(); }
    [[nodiscard]] runtime::Group& group() const { return *handle()->context->groups.find(crowd.group().id); }
    [[nodiscard]] const cage::Character& character() const { return group().asset().character; }
    [[nodiscard]] uint32_t joint(const std::string& name) const {
        for (uint32_t j = 0; j < character().skin.joints.size(); ++j) {
            if (character().skeleton.nodes[character().skin.joints[j]].name == name) {
                return j;
            }
        }
        ADD_FAILURE() << "no joint " << name;
        return 0;
    }
    [[nodiscard]] glm::dmat4 jointOf(uint32_t i, uint32_t joint) const {
        float m[16];
        EXPECT_EQ(suppleGetJointTransform(handle(), instances[i], joint, m), SUPPLE_OK);
        return glm::dmat4(glm::make_mat4(m));
    }
    [[nodiscard]] glm::dvec3 placeOf(uint32_t i, uint32_t joint) const { return glm::dvec3(jointOf(i, joint)[3]); }
    /// The size of the box that holds the cage at rest.
    [[nodiscard]] glm::vec3 sizeAtRest() const {
        const cage::Cage& cage = character().cage;
        glm::vec3 low(cage.positions[0]), high(low);
        for (const glm::vec3& p : cage.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        return high - low;
    }
    [[nodiscard]] double extent() const { return static_cast<double>(glm::length(sizeAtRest())); }

    void play(uint32_t i, uint32_t clip, double offset, uint32_t rootMotion = 0, uint32_t flags = 0) const {
        SupplePlaybackDesc desc{};
        desc.rootMotion = rootMotion;
        desc.flags = flags;
        play(i, clip, offset, desc);
    }
    /// The rest as `desc` has it.
    void play(uint32_t i, uint32_t clip, double offset, const SupplePlaybackDesc& desc) const {
        const SupplePlaybackLayer layer = loops(clip, offset);
        play(i, {&layer, 1}, desc);
    }
    void play(uint32_t i, std::span<const SupplePlaybackLayer> layers, SupplePlaybackDesc desc = {}) const {
        desc.structSize = sizeof desc;
        desc.layers = layers.data();
        desc.layerCount = static_cast<uint32_t>(layers.size());
        EXPECT_EQ(suppleSetPlayback(handle(), instances[i], &desc), SUPPLE_OK);
    }
    /// A layer that is at `offset` when the group's time is 0.
    [[nodiscard]] static SupplePlaybackLayer loops(uint32_t clip, double offset) {
        SupplePlaybackLayer layer{};
        layer.clip = clip;
        layer.flags = SUPPLE_LAYER_LOOP;
        layer.weight = layer.speed = 1.0f;
        layer.offset = offset;
        return layer;
    }
    void modify(uint32_t i, std::span<const SuppleModifier> modifiers) const {
        SuppleModifiersDesc desc{};
        desc.structSize = sizeof desc;
        desc.modifiers = modifiers.data();
        desc.modifierCount = static_cast<uint32_t>(modifiers.size());
        EXPECT_EQ(suppleSetModifiers(handle(), instances[i], &desc), SUPPLE_OK);
    }
    void modify(uint32_t i, const SuppleModifier& modifier) const { modify(i, {&modifier, 1}); }
    /// The same value for all joints.
    void setMask(uint32_t number, float value) const {
        const std::vector<float> joints(character().skin.joints.size(), value);
        SuppleMaskDesc mask{};
        mask.structSize = sizeof mask;
        mask.mask = number;
        mask.jointMask = joints.data();
        mask.jointMaskCount = static_cast<uint32_t>(joints.size());
        EXPECT_EQ(suppleSetMask(handle(), crowd.group(), &mask), SUPPLE_OK);
    }
    /// Of all morph targets.
    void setMorphWeights(uint32_t i, float weight) const {
        const std::vector<float> weights(character().morphs.targets.size(), weight);
        EXPECT_EQ(suppleSetMorphWeights(handle(), instances[i], weights.data(), static_cast<uint32_t>(weights.size())),
                  SUPPLE_OK);
    }
    void place(uint32_t i, const glm::mat4& transform) const {
        EXPECT_EQ(suppleSetTransform(handle(), instances[i], glm::value_ptr(transform)), SUPPLE_OK);
    }
    void setWind(const glm::vec3& wind) const {
        EXPECT_EQ(suppleSetWind(handle(), crowd.group(), glm::value_ptr(wind)), SUPPLE_OK);
    }
    /// A frame at a time; how many words of poses and cages are others than the CPU's.
    /// `first`: what the host records ahead of Supple.
    uint64_t run(double time, const std::function<void(VkCommandBuffer)>& first = {}) {
        EXPECT_EQ(suppleSetTime(handle(), crowd.group(), time), SUPPLE_OK);
        crowd.context().run(crowd.group(), first);
        runtime::Group& own = group();
        const skinning::PoseLayout& layout = own.instances().poseLayout();
        const skinning::DeformTable table = deformTableOf(own);
        const host::GroupOutput output = crowd.output();
        poses = as<float>(crowd.read(output.info.poses));
        const std::vector<float> cages = as<float>(crowd.read(output.info.deformedCage));
        std::vector<glm::vec4> pose(layout.stride), cage(character().cage.vertexCount());
        uint64_t off = 0;
        const auto compare = [&](std::span<const glm::vec4> here, const float* there) {
            for (size_t k = 0; k < 4 * here.size(); ++k) {
                EXPECT_TRUE(std::isfinite(there[k]));
                off += std::memcmp(&here[k / 4][static_cast<int>(k % 4)], there + k, sizeof(float)) != 0 ? 1 : 0;
            }
        };
        for (const SuppleInstance& instance : instances) {
            own.poses().playback()->writePose(instance.slot, pose);
            compare(std::span(pose).first(layout.morphWeights + (layout.morphCount + 3) / 4),
                    poses.data() + 4 * size_t{instance.slot} * layout.stride);
            skinning::deformLikeTheDevice(table, layout, pose, cage);
            compare(cage, cages.data() + 4 * size_t{instance.slot} * own.instances().cageStride());
        }
        return off;
    }

    Crowd crowd;
    std::vector<SuppleInstance> instances;
    std::vector<float> poses; ///< of the last frame
};

} // namespace supple::test
