// The poses of a group's instances on the CPU: what the host set, and how it goes to the device each frame.
#pragma once

#include "runtime/asset.h"
#include "runtime/asset_match.h"
#include "runtime/host_drivers.h"
#include "runtime/host_soft.h"
#include "runtime/host_springs.h"
#include "runtime/host_steps.h"
#include "runtime/instance_modifiers.h"
#include "runtime/instance_slots.h"
#include "skinning/deform_kernels.h"
#include "skinning/layers.h"
#include "skinning/pose_twin.h"
#include "skinning/reach.h"
#include "skinning/skinned_bounds.h"
#include "supple/supple.h"

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace supple::runtime {

/// The layout of an instance's pose for this asset. Its stride is a multiple of `strideMultiple` elements.
[[nodiscard]] skinning::PoseLayout poseLayoutOf(const Asset& asset, skinning::SkinningMode mode,
                                                uint32_t strideMultiple);

/// Setting a pose allocates nothing. Every setter of a pose sets the clip's morph weights too; those of setMorphWeights
/// stand before them until they are given back.
class HostPoses {
public:
    HostPoses() = default;
    /// All instances in the bind pose, placed by the identity. The asset must outlive this.
    /// With room for modifiers or springs the asset has its clip table.
    HostPoses(const Asset& asset, uint32_t instanceCount, const skinning::PoseLayout& layout, const StateRoom& room);

    [[nodiscard]] const skinning::PoseLayout& layout() const { return layout_; }
    /// What an instance takes of the buffer of poses.
    [[nodiscard]] size_t instanceBytes() const { return size_t{layout_.stride} * 16; }

    /// As at first: bind pose, no morph weights of the host's, identity transform.
    void reset(uint32_t instance);
    void setBindPose(uint32_t instance); ///< identity palette, morph weights 0
    void setRestPose(uint32_t instance);
    void setClipPose(uint32_t instance, uint32_t clip, double time);
    void setLayers(uint32_t instance, const SupplePoseDesc& desc); ///< desc as checkPose (runtime/pose_desc.h) takes it
    /// One column-major model-space matrix a joint; morph weights as in the rest pose.
    void setMatrixPose(uint32_t instance, const float* jointMatrices);
    void setJointMatrices(uint32_t instance, const SuppleJointMatricesDesc& desc);
    void setMorphWeights(uint32_t instance, const float* weights); ///< null: the pose's own again
    void setTransform(uint32_t instance, const glm::mat4& transform) {
        transforms_[instance] = transform;
        setPosition(instance, glm::dvec3(transform[3]));
    }
    void setPosition(uint32_t instance, const glm::dvec3& position) {
        ++versions_[instance];
        positions_[instance] = position;
        modifyInWorld(instance);
        steps_.place(instance);
    }
    /// Where the coordinates of the device begin.
    void setOrigin(const glm::dvec3& origin);
    /// Replaces the instance's list, as Playback::setModifiers. They act on poses of clips, layers and rest.
    void setModifiers(uint32_t instance, std::span<const PlacedModifier> modifiers);
    void setModifierGoal(uint32_t instance, uint32_t index, const ModifierGoal& goal);
    [[nodiscard]] bool takesModifiers() const { return modifiers_.areTaken(); }
    [[nodiscard]] uint32_t modifierCount(uint32_t instance) { return state(instance).modifierCount(); }
    [[nodiscard]] std::span<const uint32_t> modifierWords(uint32_t instance, uint32_t index) {
        return modifiers_.words(state(instance), index);
    }
    /// Takes over the first `count` instances, of the same asset or of another version of it. Joints and morph targets
    /// that the other version lacks are as in the rest pose.
    void takeOver(HostPoses& other, uint32_t count, const AssetMatch& match);

    [[nodiscard]] bool hasSprings() const { return springs_.areTaken(); }
    /// Its steps see no movement from where it stood to where it stands in the next frame.
    void teleport(uint32_t instance) { steps_.jump(instance); }
    void setWind(const glm::dvec3& velocity) { steps_.setWind(velocity); }
    void settleSteps() { steps_.settleAll(); }
    /// Poses of steps, where something is soft: create() once, recordUpload() behind write().
    [[nodiscard]] HostSoft& soft() { return soft_; }
    [[nodiscard]] const HostSoft& soft() const { return soft_; }

    /// Where the joint is, as the instance is posed and placed now, without its swinging.
    [[nodiscard]] glm::mat4 jointTransform(uint32_t instance, uint32_t joint) const;

    /// Another number whenever boundsOf() may give another box; never 0.
    [[nodiscard]] uint64_t version(uint32_t instance) const { return versions_[instance] + originVersion_; }
    /// A box that holds the instance's cage, as it is posed and placed now; nothing if joints of it swing.
    [[nodiscard]] std::optional<skinning::Box> boundsOf(uint32_t instance, const skinning::Reach& reach) const;

    struct Frame {
        uint64_t number = 0;
        double time = 0.0;      ///< of the host
        bool leavesOut = false; ///< all instances: none runs a step
    };
    /// Writes the instances, instanceBytes() each, in the layout of shaders/shared/deform.h. Those that show run the
    /// steps that are due.
    void write(const Frame& frame, const InstanceSlots& slots, std::byte* target);
    void cancelFrame(uint64_t frame);

private:
    void setPose(uint32_t instance); ///< from pose_
    [[nodiscard]] std::span<glm::vec4> held(uint32_t instance);
    void releaseHeld(uint32_t instance);
    /// Poses are kept as locals.
    [[nodiscard]] bool keepsLocals() const { return !hasLocals_.empty(); }
    void keepLocals(uint32_t instance);
    void forgetLocals(uint32_t instance) {
        if (keepsLocals()) {
            hasLocals_[instance] = 0;
        }
    }
    void setWeights(uint32_t instance, const float* weights);
    void modify(uint32_t instance); ///< the palette, anew from the locals, if the pose has some
    /// The same if modifiers have goals in the world: the instance stands elsewhere.
    void modifyInWorld(uint32_t instance) {
        if (takesModifiers() && modifiers_.anyInWorld(state(instance))) {
            modify(instance);
        }
    }
    /// Runs the instance's steps; `pose` is then what is shown.
    void step(uint32_t instance, skinning::InstancePose& pose);
    void takeOverModified(HostPoses& other, uint32_t instance, const AssetMatch& match);
    [[nodiscard]] skinning::PlaybackState state(uint32_t instance) {
        return skinning::PlaybackState(stateWords(instance));
    }
    [[nodiscard]] std::span<uint32_t> stateWords(uint32_t instance) {
        const size_t words = 4 * size_t{stateElements_};
        return std::span(states_).subspan(instance * words, words);
    }
    void takeOverJoints(const HostPoses& other, uint32_t instance, const AssetMatch& match);
    [[nodiscard]] glm::mat4 placement(uint32_t instance) const {
        glm::mat4 placed = transforms_[instance];
        placed[3] = glm::vec4(glm::vec3(positions_[instance] - origin_), 1.0f);
        return placed;
    }
    void finishPalette(uint32_t instance);
    [[nodiscard]] std::span<const float> weightsWithoutDrivers(uint32_t instance) const {
        const std::vector<float>& weights = hostWeighted_[instance] ? hostWeights_ : poseWeights_;
        return std::span(weights).subspan(instance * targetCount_, targetCount_);
    }
    /// After a change of the instance's weights, or of joints that drivers look at.
    void drive(uint32_t instance) { drivers_.drive(instance, weightsWithoutDrivers(instance)); }
    /// Morph weights as they are shown.
    [[nodiscard]] std::span<const float> weightsOf(uint32_t instance) const {
        return drivers_.any() ? drivers_.weights(instance) : weightsWithoutDrivers(instance);
    }
    [[nodiscard]] std::span<skinning::Affine> palette(uint32_t instance);
    [[nodiscard]] std::span<glm::mat4> joints(uint32_t instance);

    const Asset* asset_ = nullptr;
    skinning::PoseLayout layout_;
    skinning::SkinnedBounds skinned_;
    size_t targetCount_ = 0;
    // One run an instance.
    std::vector<skinning::Affine> palettes_;
    std::vector<glm::mat4> joints_;    ///< palettes_ before the inverse binds: of a singular one nothing leads back
    std::vector<glm::vec4> rotations_; ///< where the layout has some
    std::vector<float> poseWeights_;   ///< morph weights of the pose
    std::vector<float> hostWeights_;   ///< and what the host set instead
    std::vector<bool> hostWeighted_;
    std::vector<glm::mat4> transforms_; ///< but for the translation
    std::vector<glm::dvec3> positions_; ///< that is here
    glm::dvec3 origin_{0.0};
    std::vector<uint64_t> versions_; ///< rise whenever something of the instance is set
    uint64_t originVersion_ = 1;
    skinning::PoseMemory memory_;
    HostDrivers drivers_;

    // Where instances may have modifiers, or springs.
    uint32_t stateElements_ = 0; ///< for as many modifiers as there may be
    InstanceModifiers modifiers_;
    std::vector<uint32_t> states_;          ///< with the modifiers alone, and the transform
    std::vector<shared::Transform> locals_; ///< before modifiers, one a node of the clip table
    std::vector<glm::vec4> held_;           ///< where the pose's clips hold feet, one a foot of the clip table
    std::vector<uint8_t> hasLocals_;        ///< 0: the bind pose, or matrices
    skinning::PoseTwin twin_;
    HostSteps steps_; ///< of what follows
    HostSprings springs_;
    HostSoft soft_;
    std::vector<skinning::Affine> swungPalette_; ///< of one instance
    std::vector<glm::vec4> swungRotations_;
};

} // namespace supple::runtime
