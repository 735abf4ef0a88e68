// The springs of instances whose poses the host sets: they swing on the CPU, where these poses are.
#pragma once

#include "runtime/asset.h"
#include "runtime/spring_clock.h"
#include "skinning/joints.h"
#include "skinning/pose_twin.h"
#include "skinning/spring_twin.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::runtime {

/// Swinging allocates nothing. A frame's steps are posed straight between the pose of the frame before and its own.
class HostSprings {
public:
    HostSprings() = default; ///< not taken
    /// The asset, whose clip table has springs, must outlive this.
    HostSprings(const Asset& asset, uint32_t capacity);
    /// False: no instance has springs, whatever this is told.
    [[nodiscard]] bool areTaken() const { return clock_.isTaken(); }

    /// As it is posed from the next frame on: one local a node of the clip table.
    void setPose(uint32_t slot, std::span<const shared::Transform> locals);
    /// The same by what joints are set to, in model space. Other nodes rest where their parents are. Shear is lost for
    /// joints that swing or hang on them; all others keep the host's matrix. Nodes with a fixed matrix keep that.
    void setJoints(uint32_t slot, std::span<const glm::mat4> joints);
    void setBindPose(uint32_t slot); ///< it does not swing
    void settle(uint32_t slot) { clock_.settle(slot); }
    void settleAll() { clock_.settleAll(); }
    void jump(uint32_t slot) { clock_.jump(slot, time_); }
    void place(uint32_t slot) { clock_.place(slot, time_); }

    /// A frame begins.
    void setTime(uint64_t frame, double time);
    /// Runs the steps that are due in it. `placement`: on the device. False: it does not swing.
    [[nodiscard]] bool swing(uint32_t slot, const SpringPlace& place, const glm::mat4& placement);
    /// Turns the joints that swing, and what hangs on them: as the last slot has swung. `rotations`: of the joints, or
    /// none.
    void show(std::span<skinning::Affine> palette, std::span<glm::vec4> rotations) const;

    void cancelFrame(uint64_t frame);
    /// The first `count` instances, of the same asset.
    void takeOver(const HostSprings& other, uint32_t count);

private:
    [[nodiscard]] std::span<shared::Transform> of(std::vector<shared::Transform>& locals, uint32_t slot) const {
        return std::span(locals).subspan(slot * nodeCount_, nodeCount_);
    }
    [[nodiscard]] std::span<glm::vec4> stateOf(std::vector<glm::vec4>& states, uint32_t slot) const {
        return std::span(states).subspan(slot * stateElements_, stateElements_);
    }
    void keepForUndo(uint32_t slot);
    void pose(uint32_t slot, double part); ///< into shown_

    const Asset* asset_ = nullptr;
    size_t nodeCount_ = 0, stateElements_ = 0;
    std::vector<uint32_t> hanging_;     ///< joints that swing, and those below them
    std::vector<uint32_t> jointOfNode_; ///< or kNone
    std::vector<uint32_t> needed_;      ///< places: steps ask for their locals, or they swing, or hang on such
    std::vector<glm::dmat4> globals_;   ///< memory of setJoints
    SpringClock clock_;
    double time_ = 0.0, timeBefore_ = 0.0; ///< of the last frame, and of that before
    uint64_t frame_ = 0;
    skinning::SpringTwin twin_;
    skinning::PoseTwin shownTwin_;
    std::vector<uint32_t> placedWords_; ///< of an instance at the origin without modifiers, for shownTwin_
    std::vector<shared::Transform> shown_;

    // By slot, one run each.
    std::vector<shared::Transform> posed_, before_; ///< as it is posed now, and in the last frame
    std::vector<glm::vec4> states_;
    struct Slot {
        bool isPosed = false;
        double time = 0.0; ///< of the last frame
        uint64_t frame = 0;
    };
    std::vector<Slot> slots_;
    // What the slots of a frame were before it.
    std::vector<uint32_t> undone_;
    std::vector<shared::Transform> undoBefore_;
    std::vector<glm::vec4> undoStates_;
    std::vector<Slot> undoSlots_;
};

} // namespace supple::runtime
