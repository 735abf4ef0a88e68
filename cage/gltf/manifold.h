// EXT_mesh_manifold of a glTF file: which vertices of a mesh are one. Private to cage/gltf/. All of these throw
// Refusal.
#pragma once

#include "cage/gltf/document.h"
#include "cage/gltf/mesh.h"
#include "cage/message.h"

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace supple::cage::gltf {

using VertexPairs = std::vector<std::pair<uint32_t, uint32_t>>;

/// The pairs that EXT_mesh_manifold merges; nothing where the mesh has none that can be used. `meshIndex`: among the
/// file's meshes; `positionAccessors`: by primitive.
[[nodiscard]] std::optional<VertexPairs> readManifold(const Document& document, size_t meshIndex, const Mesh& mesh,
                                                      std::span<const int> positionAccessors, Warnings& warnings);

} // namespace supple::cage::gltf
