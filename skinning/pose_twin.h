// The pose pass of one instance on the CPU, in the device's own arithmetic: the same source (shaders/pose/*.h), so the
// same bits. skinning/played_pose.h has the same in double, for what floats are measured against.
#pragma once

#include "shaders/pose/affine.h"
#include "shaders/shared/pose.h"
#include "skinning/clip_table.h"
#include "skinning/deform_kernels.h"
#include "skinning/layers.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::skinning {

/// Posing allocates nothing.
class PoseTwin {
public:
    PoseTwin() = default;
    /// The table, with its words, must outlive this. `transition`: PosePush::transition.
    PoseTwin(const ClipTable& table, const PoseLayout& layout, uint32_t transition);

    /// Where a pose stands: at the instance's transform, or, as ends do, in model space and where it has travelled from
    /// there.
    enum class Stands { placed, unplaced };
    /// `state`: the instance's words (skinning/playback.h). `masks`: those of the group.
    void pose(std::span<const uint32_t> state, std::span<const float> masks, double time,
              Stands stands = Stands::placed);

    /// The same, up to modifiers and without the hierarchy. What follows is then of no pose: what an instance shows
    /// before modifiers is in locals() and weights(). pose() leaves there what it shows behind them.
    void sample(std::span<const uint32_t> state, std::span<const float> masks, double time,
                Stands stands = Stands::placed);
    /// One a node of the table; not of the bind pose.
    [[nodiscard]] std::span<const shared::Transform> locals() const { return locals_; }
    /// Without what drivers add.
    [[nodiscard]] std::span<const glm::vec4> weights() const { return weights_; }

    /// pose() of local transforms, one a node of the table, instead of what is played; modifiers change them in
    /// place. `held`: where clips hold feet, one for every foot of the table.
    void poseLocals(std::span<const uint32_t> state, std::span<const shared::Transform> locals,
                    std::span<const glm::vec4> held);
    /// Mixes where a layer holds feet into what those before it do; `root`: what is taken out of its clip.
    void hold(const cage::Character& character, const Rig& rig, const Layer& layer, const RootSelection& root,
              std::span<glm::vec4> held) const;

    /// Where the last pose stands: see Stands.
    [[nodiscard]] const shared::Affine& place() const { return place_; }
    // Of the last pose, which is not the bind pose: the joint's node in model space, and where the instance stands,
    // with what it has travelled.
    [[nodiscard]] glm::mat4 joint(uint32_t joint) const;
    [[nodiscard]] glm::mat4 placedJoint(uint32_t joint) const;
    /// joint(joint), then its inverse bind matrix: by rows.
    [[nodiscard]] shared::Affine skinned(uint32_t joint) const;
    /// Writes what the pass leaves for the deform pass: layout.stride elements; those behind the last weights stay.
    void write(std::span<glm::vec4> pose) const;

    // The same straight between the last pose and the last one of another twin, both ends: `part` of the way. The
    // transform is that in `state`.
    [[nodiscard]] glm::mat4 placedJointBetween(const PoseTwin& later, float part, std::span<const uint32_t> state,
                                               uint32_t joint) const;
    void writeBetween(const PoseTwin& later, float part, std::span<const uint32_t> state,
                      std::span<glm::vec4> pose) const;

private:
    static void put(const shared::Affine& m, std::span<glm::vec4> pose, size_t at);
    [[nodiscard]] shared::Affine own(uint32_t joint) const; ///< skinned(joint); in the bind pose, nothing
    [[nodiscard]] const shared::Affine& nodeOf(uint32_t joint) const;
    void finish(std::span<const uint32_t> state); ///< locals_ are there: modifiers, then globals_
    void drive();                                 ///< shownWeights_, of locals_ and weights_

    const ClipTable* table_ = nullptr;
    PoseLayout layout_;
    shared::PosePush push_{};
    std::vector<shared::Transform> locals_;
    std::vector<shared::Affine> globals_;
    std::vector<glm::vec4> weights_;
    std::vector<glm::vec4> shownWeights_; ///< with what drivers add
    std::vector<glm::vec4> driverTurns_;  ///< of the nodes that drivers look at
    std::vector<glm::vec4> held_;         ///< by foot
    shared::Affine place_{};
    bool bindPose_ = true;
};

} // namespace supple::skinning
