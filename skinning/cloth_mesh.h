// Which vertices and constraints the cloths of a character have.
#pragma once

#include "cage/character.h"

#include <array>
#include <cstdint>
#include <vector>

namespace supple::skinning {

/// A cloth's vertices, numbered anew: those that hang on joints come first, both sorts in the order of the cage. They
/// are the vertices of all faces that have a painted one.
struct ClothMesh {
    std::vector<uint32_t> vertices; ///< of the cage
    uint32_t hangingCount = 0;
    std::vector<uint32_t> faceStarts; ///< of these faces; one more
    std::vector<uint32_t> faceVertices;

    [[nodiscard]] size_t faceCount() const { return faceStarts.size() - 1; }
};
/// One for each of Character::cloths.
[[nodiscard]] std::vector<ClothMesh> clothMeshes(const cage::Character& character);

/// Pairs of vertices, the lower one first, none of which is there twice or hangs at both ends: edges, the other pairs
/// of vertices two apart along a face, and those two apart along a line of quads or opposite over an edge of two
/// triangles.
struct ClothPairs {
    using Pair = std::array<uint32_t, 2>;
    std::vector<Pair> edges, diagonals, bends; ///< rising
};
[[nodiscard]] ClothPairs clothPairs(const ClothMesh& mesh);

} // namespace supple::skinning
