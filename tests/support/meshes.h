// Small cages for the tests, and cages read from OBJ files.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace supple::test {

using Polygons = std::vector<std::vector<uint32_t>>;

[[nodiscard]] cage::Cage makeCage(std::vector<glm::vec3> positions, const Polygons& polygons);

/// Corners at +-1.
[[nodiscard]] cage::Cage cube();
/// columns x rows quads in the xy plane, spacing 1, facing +z; vertex (x, y) is y * (columns + 1) + x.
[[nodiscard]] cage::Cage grid(uint32_t columns, uint32_t rows);
/// around x across quads, all of valence 4.
[[nodiscard]] cage::Cage torus(uint32_t around, uint32_t across);
/// 2 n quads between two poles of valence n; the other vertices have valence 3.
[[nodiscard]] cage::Cage trapezohedron(uint32_t n);
/// A flat disk (angle = whole turn: n interior quads round a vertex) or sector of quads round vertex 0: `sectors`
/// sectors of rings x rings quads each. An open sector's apex is a boundary vertex with `sectors` faces.
[[nodiscard]] cage::Cage fan(uint32_t sectors, uint32_t rings, double angle, bool closed);
/// A closed prism: n quads between two n-gons.
[[nodiscard]] cage::Cage prism(uint32_t n);
/// The cage without some faces; vertices that no face uses any more are dropped.
[[nodiscard]] cage::Cage withoutFaces(const cage::Cage& cage, const std::vector<uint32_t>& faces);

/// Moves every vertex by up to `amount` in each coordinate; the same for the same seed everywhere.
[[nodiscard]] cage::Cage perturbed(cage::Cage cage, float amount, uint32_t seed);
/// Rotates the corners of face f by f mod sides: the same surface, other starting corners.
[[nodiscard]] cage::Cage rotatedFaces(cage::Cage cage);

/// One Catmull-Clark step in double on the cage's polygons, boundary as B-spline curves, corners with one face kept
/// where they are. The first vertexCount() positions are the vertex points.
struct RefinedCage {
    cage::Cage cage; ///< connectivity; its positions are the rounded ones
    std::vector<glm::dvec3> positions;
};
[[nodiscard]] RefinedCage refineCatmullClark(const cage::Cage& cage, const std::vector<glm::dvec3>& positions,
                                             bool sharpCorners);

[[nodiscard]] std::vector<glm::dvec3> doublePositions(const cage::Cage& cage);
[[nodiscard]] bool allQuads(const cage::Cage& cage);
/// Diagonal of the bounding box.
[[nodiscard]] double extent(const std::vector<glm::dvec3>& positions);

/// v and f lines of an OBJ file; nullopt where the file cannot be read or an index is out of range.
[[nodiscard]] std::optional<cage::Cage> readObj(const std::string& path);

} // namespace supple::test
