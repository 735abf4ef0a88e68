// Normals of the control polygons themselves: of a file, or for viewers that know no surface.
#pragma once

#include "cage/character.h"
#include "cage/topology.h"

#include <span>
#include <vector>

namespace supple::cage {

/// One unit normal a corner: the cage's own, if it has one. Otherwise it is the mean of the face normals round the
/// corner's vertex, weighted by the corners' angles, over the faces of its smooth group (cage/smooth_groups.h). Takes
/// any cage, manifold or not.
[[nodiscard]] std::vector<glm::vec3> cornerNormals(const Cage& cage);

/// The same of the cage with its vertices elsewhere: the means of the face normals there, for its own normals are those
/// of the rest pose. Smooth groups are those of the cage. `positions`: one per vertex.
[[nodiscard]] std::vector<glm::vec3> deformedCornerNormals(const Cage& cage, std::span<const glm::vec3> positions);

/// A file's normal as Cage::cornerNormals keeps it: of unit length, to the bit as it is if it is of that length
/// already; zero if it is no direction.
[[nodiscard]] glm::vec3 unitNormal(const glm::dvec3& given);

/// The same of a tangent and the sign of its bitangent, as Cage::cornerTangents keeps them.
[[nodiscard]] glm::vec4 unitTangent(const glm::dvec4& given);

/// Whether two unit normals are the same to a degree. Exporters write the same normal twice on the two sides of a seam,
/// but may round it differently.
[[nodiscard]] bool normalsAgree(const glm::vec3& a, const glm::vec3& b);

/// Whether an edge of the cage is hard by its normals: there is a face on both sides, and at one end of the edge they
/// have normals that disagree. (Where a hard edge ends inside the surface, they agree at that end.) Corners without a
/// normal do not say.
[[nodiscard]] bool hasSplitNormals(const Cage& cage, const Topology& topology, const Topology::Edge& edge);

} // namespace supple::cage
