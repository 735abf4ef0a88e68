// A mesh of a glTF file as the file has it: vertices, triangles, attributes; nothing welded. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/message.h"
#include "cage/split/mesh.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace supple::cage::gltf {

using split::Mesh;

/// Primitives of points and lines are left out with a warning; nothing comes back if no others are there. Throws
/// Refusal.
[[nodiscard]] std::optional<Mesh> readMesh(const Document& document, uint32_t meshNode, size_t jointCount,
                                           std::span<const Material> materials, Warnings& warnings);

/// What a mesh without triangles is.
[[nodiscard]] std::string nameOfNoTriangles(const file::Mesh& mesh);

} // namespace supple::cage::gltf
