// The cloths of one instance on the CPU, in the device's own arithmetic: the same source (shaders/soft/cloth.h), so the
// same bits.
#pragma once

#include "shaders/pose/affine.h"
#include "skinning/cloth_table.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::skinning {

/// Steps allocate nothing. A state has ClothTable::stateElements, as the device has it; before the first step it may be
/// anything.
class ClothTwin {
public:
    /// The table must outlive this with its words.
    explicit ClothTwin(const ClothTable& table);

    struct Step {
        shared::Affine move = shared::identity(); ///< how the model's frame of the step before lies in that of this one
        glm::vec3 down{0.0f, -1.0f, 0.0f};        ///< of the world, in the model's frame
        glm::vec3 wind{0.0f};                     ///< the same
        bool settles = false, skips = false;      ///< it begins anew; behind steps that are left out
        bool jumps = false;                       ///< the instance has not moved there
        bool light = false;                       ///< a spring in the place of constraints
    };
    /// `goals`: the cage in the step's pose, in model space; `joints`: what it takes each joint's bind pose by; none:
    /// all stand in their bind pose.
    void step(uint32_t cloth, std::span<const glm::vec4> goals, std::span<const shared::Affine> joints, const Step& now,
              std::span<glm::vec4> state);
    /// Moves the shown vertices of a cage, `part` of the way from the last step but one to the last.
    void show(uint32_t cloth, float part, const shared::Affine& place, std::span<const glm::vec4> state,
              std::span<glm::vec4> cage) const;

    [[nodiscard]] uint32_t vertexCount(uint32_t cloth) const;
    /// The element of the table where a vertex begins.
    [[nodiscard]] uint32_t vertexElement(uint32_t cloth, uint32_t vertex) const;
    /// Where a vertex is after the last step, how fast it goes, and how far it is from where joints have it.
    [[nodiscard]] glm::vec3 place(uint32_t cloth, uint32_t vertex, std::span<const glm::vec4> state) const;
    [[nodiscard]] glm::vec3 speed(uint32_t cloth, uint32_t vertex, std::span<const glm::vec4> state) const;
    [[nodiscard]] glm::vec3 offset(uint32_t cloth, uint32_t vertex, std::span<const glm::vec4> state) const;

private:
    const ClothTable* table_;
    std::vector<glm::vec4> places_, colliders_;
    std::vector<float> sums_;
};

} // namespace supple::skinning
