// The order of a group's pieces in a tree (shaders/queries/tree.glsl).
#pragma once

#include "base/result.h"
#include "runtime/queries/query_pieces.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace supple::runtime {

/// Puts the leaves of a tree behind the pieces: which piece each is. Pieces that lie together in the bind pose, whose
/// vertices `positions` are, are together in the tree. The element where they begin, or an error if the table has then
/// more than `mostElements`.
[[nodiscard]] Result<uint32_t> addLeaves(PieceTable& table, std::span<const glm::vec3> positions,
                                         uint64_t mostElements);

} // namespace supple::runtime
