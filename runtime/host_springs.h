// The springs of instances whose poses the host sets: they swing on the CPU, where these poses are.
#pragma once

#include "runtime/asset.h"
#include "runtime/host_steps.h"
#include "skinning/joints.h"
#include "skinning/pose_twin.h"
#include "skinning/spring_twin.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::runtime {

/// Swinging allocates nothing. Which steps are due, HostSteps knows.
class HostSprings {
public:
    HostSprings() = default; ///< not taken
    /// The asset, whose clip table has springs, must outlive this.
    HostSprings(const Asset& asset, uint32_t capacity);
    /// False: no instance has springs, whatever this is told.
    [[nodiscard]] bool areTaken() const { return !states_.empty(); }

    /// As it is posed from the next frame on: one local a node of the clip table.
    void setPose(uint32_t slot, std::span<const shared::Transform> locals);
    /// The same by what joints are set to, in model space. Other nodes rest where their parents are. Shear is lost for
    /// joints that swing or hang on them; all others keep the host's matrix. Nodes with a fixed matrix keep that.
    void setJoints(uint32_t slot, std::span<const glm::mat4> joints);

    // An instance in a frame: its steps in their order, then what is shown.
    void begin(uint32_t slot);
    /// `placement`: on the device.
    void step(uint32_t slot, const HostSteps::Due& due, uint32_t step, const glm::mat4& placement);
    /// Turns the joints that swing, and what hangs on them, as the last step has left them. `rotations`: of the joints,
    /// or none.
    void showStep(uint32_t slot, std::span<skinning::Affine> palette, std::span<glm::vec4> rotations);
    /// The same as the frame shows them: `part` of the way from the last step but one to the last.
    void show(uint32_t slot, float part, std::span<skinning::Affine> palette, std::span<glm::vec4> rotations);

    void restore(uint32_t slot); ///< as before the last frame, which is cancelled
    /// The first `count` instances, of the same asset.
    void takeOver(const HostSprings& other, uint32_t count);

private:
    [[nodiscard]] std::span<shared::Transform> of(std::vector<shared::Transform>& locals, uint32_t slot) const {
        return std::span(locals).subspan(slot * nodeCount_, nodeCount_);
    }
    [[nodiscard]] std::span<glm::vec4> stateOf(std::vector<glm::vec4>& states, uint32_t slot) const {
        return std::span(states).subspan(slot * stateElements_, stateElements_);
    }
    void pose(uint32_t slot, float part); ///< into shown_
    void turn(std::span<glm::vec4> state, float part, std::span<skinning::Affine> palette,
              std::span<glm::vec4> rotations); ///< shown_

    const Asset* asset_ = nullptr;
    size_t nodeCount_ = 0, stateElements_ = 0;
    std::vector<uint32_t> hanging_;     ///< joints that swing, and those below them
    std::vector<uint32_t> jointOfNode_; ///< or kNone
    std::vector<uint32_t> needed_;      ///< places: steps ask for their locals, or they swing, or hang on such
    std::vector<glm::dmat4> globals_;   ///< memory of setJoints
    skinning::SpringTwin twin_;
    skinning::PoseTwin shownTwin_;
    std::vector<uint32_t> placedWords_; ///< of an instance at the origin without modifiers, for shownTwin_
    std::vector<shared::Transform> shown_;

    // By slot, one run each.
    std::vector<shared::Transform> posed_, before_; ///< as it is posed now, and in the last frame
    std::vector<glm::vec4> states_;
    // What the slots of a frame were before it.
    std::vector<shared::Transform> undoBefore_;
    std::vector<glm::vec4> undoStates_;
};

} // namespace supple::runtime
