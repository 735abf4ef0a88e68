// An instance that plays, jiggles and has cloths, on the CPU: the cage that the device leaves, to the bit.
#pragma once

#include "cage/character.h"
#include "runtime/step_clock.h"
#include "shaders/soft/jiggle.h"
#include "skinning/cloth_twin.h"
#include "skinning/deform_twin.h"
#include "skinning/pose_twin.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

namespace supple::test {

class PlayedSoft {
public:
    /// All must outlive this.
    PlayedSoft(const cage::Character& character, const skinning::ClipTable& clips, const skinning::DeformTable& table,
               const skinning::PoseLayout& layout, uint32_t transition);

    /// Runs the steps that are due of what `state` plays.
    /// `light`: cloths are springs.
    void run(std::span<const uint32_t> state, std::span<const float> masks, const runtime::StepClock::Due& due,
             bool light = false);
    /// Fills the cage that is shown at a time.
    void show(std::span<const uint32_t> state, std::span<const float> masks, double time, float part,
              std::span<glm::vec4> cage);

private:
    /// The cage of the last pose in model space, and what joints are moved by.
    void deformUnplaced(std::span<glm::vec4> cage);
    void runCloths(std::span<const glm::vec4> goals, const skinning::ClothTwin::Step& now);

    const cage::Character* character_;
    const skinning::DeformTable* table_;
    skinning::PoseLayout layout_;
    skinning::PoseTwin twin_;
    std::vector<uint32_t> vertices_; ///< that jiggle
    std::vector<shared::Jiggling> jiggling_;
    std::unique_ptr<const skinning::ClothTable> clothTable_; ///< stays where the twin looks
    skinning::ClothTwin cloths_;
    std::vector<glm::vec4> clothState_;
    std::vector<shared::Affine> joints_;
    shared::Affine way_; ///< at the last step
};

} // namespace supple::test
