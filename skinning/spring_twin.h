// The springs of one instance on the CPU, in the device's own arithmetic: the same source (shaders/pose/springs.h), so
// the same bits.
#pragma once

#include "shaders/pose/affine.h"
#include "shaders/shared/pose.h"
#include "skinning/clip_table.h"

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::skinning {

/// Stepping and showing allocate nothing. Locals are those of nodes of the table.
class SpringTwin {
public:
    SpringTwin() = default;
    /// The table, which has springs, must outlive this with its words.
    explicit SpringTwin(const ClipTable& table);

    /// Elements of a state: what an instance keeps from step to step, as the device has it. Before the first step it
    /// may be anything finite.
    [[nodiscard]] static size_t stateElements(const ClipTable& table);

    struct Step {
        shared::Affine move;  ///< how the model's frame of the step before lies in that of this step
        shared::Affine place; ///< where the instance stands
        bool settles = false; ///< tails at rest in the pose
        glm::vec3 wind{0.0f}; ///< in the model's frame
    };
    /// A step, posed by `locals`.
    void step(std::span<const shared::Transform> locals, const Step& now, std::span<glm::vec4> state);
    /// Turns the joints of what is shown: `part` of the way from the last step but one to the last.
    void show(std::span<glm::vec4> state, float part, std::span<shared::Transform> locals);

    /// Of the last step: each joint that swings has a head and a tail.
    struct Bone {
        glm::vec3 head{0.0f}, tail{0.0f}, posedTail{0.0f};
    };
    [[nodiscard]] std::vector<Bone> bones();

private:
    const ClipTable* table_ = nullptr;
    shared::PosePush push_{};
    std::vector<glm::vec4> colliders_;
    std::vector<shared::Transform> locals_; ///< of the last step
    std::vector<shared::Affine> globals_;   ///< of the nodes that springs need
};

} // namespace supple::skinning
