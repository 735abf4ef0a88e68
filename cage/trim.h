// Trimming: which image takes parts of a material's faces away, and where a face lies in its tile (docs/trimming.md).
#pragma once

#include "cage/character.h"

#include <optional>
#include <vector>

namespace supple::cage {

/// Beyond these a float holds a tile's number and a place in it no longer well.
inline constexpr uint32_t kMaxTrimTiles = 1024;

/// The material's own trim, else what alphaMode mask with a texture comes to: the base color's alpha, which further
/// alphas (of the factor, of COLOR_0) multiply.
[[nodiscard]] std::optional<Trim> trimOf(const Material& material);

/// Whether some face of the cage has a tile.
[[nodiscard]] bool hasTrimTiles(const Cage& cage);

/// Per corner of the cage (x, y): x = u + 2 * tile, with tile -1 for faces without one, and y = v. (u, v) in [0, 1] is
/// the corner's place in the tile: the four corners of a quad are (0, 0), (1, 0), (1, 1), (0, 1); those of other faces
/// are a regular polygon on the circle that the tile holds, its first side at v = 0's side of it. Counting tiles by two
/// leaves room between them, so that no interpolation within a face rounds into the next one.
[[nodiscard]] std::vector<glm::vec2> tileCoordinates(const Cage& cage);

} // namespace supple::cage
