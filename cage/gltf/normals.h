// Normals and tangents of a glTF primitive, as the file has them. Private to cage/gltf/.
#pragma once

#include "cage/gltf/document.h"
#include "cage/message.h"

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace supple::cage::gltf {

/// NORMAL as unit vectors, one per POSITION element; empty if the primitive has none. A normal that is zero or not
/// finite becomes zero, which means none (Cage::cornerNormals), with a warning. Throws Refusal.
[[nodiscard]] std::vector<glm::vec3> readNormals(const Document& document, const file::Primitive& primitive,
                                                 size_t vertexCount, const std::string& element, Warnings& warnings);

/// TANGENT, one per POSITION element: unit vectors, and a sign of 1 or -1. Empty if the primitive has none, or no
/// normals. A tangent that is zero or not finite becomes zero, which means none (Cage::cornerTangents), with a warning.
/// Throws Refusal.
[[nodiscard]] std::vector<glm::vec4> readTangents(const Document& document, const file::Primitive& primitive,
                                                  size_t vertexCount, const std::string& element, Warnings& warnings);

} // namespace supple::cage::gltf
