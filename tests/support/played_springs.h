// An instance that plays and swings, on the CPU: what the device's pose pass leaves, to the bit.
#pragma once

#include "runtime/playback.h"
#include "skinning/pose_twin.h"
#include "skinning/spring_twin.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace supple::test {

class PlayedSprings {
public:
    /// The table must outlive this.
    PlayedSprings(const skinning::ClipTable& table, const skinning::PoseLayout& layout, uint32_t transition);

    /// In all steps from now on, in the frame that the host places.
    void setWind(const glm::vec3& wind) { wind_ = wind; }
    enum class Begins { anew, withoutMove, asItIs };
    /// Runs a step, posed by what `state` plays at its time. `moved`: the rows of a move (shaders/shared/pose.h).
    void step(std::span<const uint32_t> state, std::span<const float> masks, int64_t step, Begins begins,
              std::optional<std::array<glm::vec4, 3>> moved = std::nullopt);
    /// What is shown at a time, as the pass leaves it.
    void show(std::span<const uint32_t> state, std::span<const float> masks, double time, float part,
              std::span<glm::vec4> pose);

    using Bone = skinning::SpringTwin::Bone;
    [[nodiscard]] std::vector<Bone> bones() { return springs_.bones(); } ///< of the last step
    /// The state as the device keeps it.
    [[nodiscard]] std::span<const glm::vec4> words() const { return state_; }

private:
    skinning::PoseTwin twin_;
    skinning::SpringTwin springs_;
    std::vector<glm::vec4> state_;
    glm::vec3 wind_{0.0f};
    std::vector<shared::Transform> locals_;
};

} // namespace supple::test
