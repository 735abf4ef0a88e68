// Nodes of a glTF file: the skeleton, and which node's mesh is read. Private to cage/gltf/. All of these throw Refusal.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/message.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace supple::cage::gltf {

[[nodiscard]] Skeleton readSkeleton(const Document& document);

/// The nodes with meshes of a scene, in the file's order; of the whole file if it has no scene, or no mesh in the
/// scene. `scene`: the file's own choice, else the first, if it is not given.
[[nodiscard]] std::vector<uint32_t> findMeshNodes(const Document& document, std::optional<uint32_t> scene,
                                                  Warnings& warnings);

} // namespace supple::cage::gltf
