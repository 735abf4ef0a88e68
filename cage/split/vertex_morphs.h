// Displacements of vertices by morph targets, as makers of characters read them.
#pragma once

#include "cage/character.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace supple::cage::split {

/// One vertex's displacement in one target.
struct MorphDelta {
    uint32_t target = 0;
    glm::vec3 delta{0.0f};

    bool operator==(const MorphDelta&) const = default;
};

/// The displacements of vertices that are appended one after the other: by target, those of zero dropped.
class VertexMorphs {
public:
    /// `moved`: vertices, counted from 0, and their displacements that are not zero, target by target.
    void append(size_t vertexCount, std::span<const std::pair<uint32_t, MorphDelta>> moved);

    [[nodiscard]] std::span<const MorphDelta> of(uint32_t vertex) const {
        return std::span(deltas_).subspan(starts_[vertex], starts_[vertex + 1] - starts_[vertex]);
    }
    [[nodiscard]] bool empty() const { return starts_.size() == 1; }

private:
    std::vector<uint32_t> starts_{0};
    std::vector<MorphDelta> deltas_;
};

} // namespace supple::cage::split
