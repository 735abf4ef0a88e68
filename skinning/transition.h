// Transitions: an instance goes over from what it has shown to what it plays from a time on. Here is kept what was
// shown, and how fast it moved, in the words that shaders/pose/transition.h reads. The formulas are there.
#pragma once

#include "shaders/pose/affine.h"
#include "shaders/shared/pose.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::skinning {

enum class TransitionKind : uint32_t { deadBlending = shared::kDeadBlending, quintic = shared::kQuintic };

struct Transition {
    TransitionKind kind = TransitionKind::deadBlending;
    double start = 0.0;   ///< the group's time
    float seconds = 0.0f; ///< 0: none
};

/// A pose before the hierarchy: of nodes in the order of the clip table, and morph weights.
struct SampledPose {
    std::vector<shared::Transform> locals;
    std::vector<glm::vec4> weights;

    /// Keeps its memory if it had as much.
    void assign(std::span<const shared::Transform> nodes, std::span<const glm::vec4> quads) {
        locals.assign(nodes.begin(), nodes.end());
        weights.assign(quads.begin(), quads.end());
    }
};

/// What a transition starts from.
struct TransitionEnds {
    /// What was played so far, at three times that are shared::kTransitionStep apart.
    std::array<SampledPose, 3> shown;
    uint32_t now = 1; ///< which of them is at the start
    /// What is played from now on: at the start, and one and two steps after it. The quintic needs it.
    std::array<SampledPose, 3> played;
};

/// Elements of a state that a transition takes.
[[nodiscard]] uint32_t transitionElements(uint32_t nodeCount, uint32_t morphCount);
/// When the transition began that has these words.
[[nodiscard]] double transitionStart(std::span<const uint32_t> words);
/// `words`: those of transitionElements().
void writeTransition(const Transition& transition, const TransitionEnds& ends, std::span<uint32_t> words);

} // namespace supple::skinning
