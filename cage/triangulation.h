// Cutting the faces of a cage into triangles: as the file does it, or by clipping ears.
#pragma once

#include "cage/character.h"
#include "cage/polygons.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::cage {

/// Faces with more sides are cut into a fan from their first corner, also if they are concave: clipping ears takes the
/// square of the number of sides.
inline constexpr uint32_t kMostClippedSides = 1024;

/// Three corners per triangle, sides - 2 triangles per face, face after face, wound as the face: Cage::faceTriangles if
/// the cage has them, else ears clipped in the rest pose.
[[nodiscard]] std::vector<uint32_t> triangulate(const Cage& cage);

/// Cuts one polygon of at least three corners into triangles that do not fold over each other if the polygon, seen
/// along its area vector, does not cross itself. A convex polygon becomes a fan from its first corner. Appends three
/// numbers of its corners per triangle, sides - 2 triangles whatever the polygon is.
void clipEars(std::span<const glm::vec3> corners, std::vector<uint32_t>& triangles);

/// Whether one of the triangles, three numbers of the polygon's corners each, is wound against the polygon's area
/// vector.
[[nodiscard]] bool foldsOver(std::span<const glm::vec3> corners, std::span<const uint32_t> triangles);

/// Finds again which of a file's triangles a polygon was merged from.
class FileTriangles {
public:
    /// `triangles`: three vertices each. `welded` maps a vertex to its cage vertex.
    FileTriangles(std::span<const uint32_t> triangles, std::span<const uint32_t> welded);

    /// Appends the file's triangles of a polygon as clipEars() does and returns true. Returns false, and appends
    /// nothing, if the file's triangles do not fill it. `polygon`: vertices, none of which are welded to each other.
    [[nodiscard]] bool cut(std::span<const uint32_t> polygon, std::vector<uint32_t>& triangles) const;

private:
    struct Side {
        uint32_t from = 0, to = 0; ///< cage vertices
        uint32_t opposite = 0;
    };
    std::span<const uint32_t> welded_;
    std::vector<Side> sides_; ///< of all triangles, sorted
};

} // namespace supple::cage
