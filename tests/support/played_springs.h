// Springs on the CPU, by the device's own source (shaders/pose/springs.h): the same bits.
#pragma once

#include "runtime/playback.h"
#include "skinning/pose_twin.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace supple::test {

/// The springs of one instance.
class SpringTwin {
public:
    /// The table must outlive this.
    SpringTwin(const skinning::ClipTable& table, const skinning::PoseLayout& layout, uint32_t transition);

    enum class Begins { anew, withoutMove, asItIs };
    /// Runs a step, posed by what `state` plays at its time. `moved`: the rows of a move (shaders/shared/pose.h).
    void step(std::span<const uint32_t> state, std::span<const float> masks, int64_t step, Begins begins,
              std::optional<std::array<glm::vec4, 3>> moved = std::nullopt);
    /// What is shown at a time, as the pass leaves it.
    void show(std::span<const uint32_t> state, std::span<const float> masks, double time, float part,
              std::span<glm::vec4> pose);

    /// Of the last step: each joint that swings has a head and a tail.
    struct Bone {
        glm::vec3 head{0.0f}, tail{0.0f}, posedTail{0.0f};
    };
    [[nodiscard]] std::span<const Bone> bones() const { return bones_; }
    /// The state as the device keeps it.
    [[nodiscard]] std::span<const glm::vec4> words() const { return springs_; }

private:
    const skinning::ClipTable* table_;
    skinning::PoseTwin twin_;
    shared::PosePush push_{};
    std::vector<glm::vec4> springs_, colliders_;
    std::vector<shared::Transform> locals_;
    std::vector<shared::Affine> globals_;
    std::vector<Bone> bones_;
};

} // namespace supple::test
