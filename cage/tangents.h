// Tangents of the control polygons themselves: of a file, or from texture coordinates.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::cage {

/// glTF's TANGENT for every corner of triangles: a unit vector and a sign, 1 or -1, such that the bitangent is sign *
/// cross(normal, tangent). It is the file's (Cage::cornerTangents), if the corner has one. Otherwise it is what
/// MikkTSpace gives for the triangles: M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited" (2008), chapter 3,
/// with the welding, the groups and the angle weights of the author's program, whose sign is the opposite of glTF's.
/// Zero, with the sign 1, where the texture coordinates give no direction. `triangles`: three corners of the cage each.
/// `normals`: unit normals, one per corner of the cage (cornerNormals()). `uvs`: texture coordinates, one per corner
/// (mapUvs(), or Cage::cornerUvs), or none. O(corners log corners).
[[nodiscard]] std::vector<glm::vec4> triangleTangents(const Cage& cage, std::span<const uint32_t> triangles,
                                                      std::span<const glm::vec3> normals,
                                                      std::span<const glm::vec2> uvs);

} // namespace supple::cage
