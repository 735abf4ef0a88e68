// A mesh of a glTF file as the file has it: vertices, triangles, attributes; nothing welded. Private to cage/gltf/.
#pragma once

#include "cage/bind_space.h"
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

/// Primitives of which nothing is drawn, and those that are faulty, are left out with a warning. Nothing comes back if
/// no others are there: then `whyEmpty` says why, if no warning does. Vertices of primitives that the skin does not
/// move hang on the binding's follower. Throws Refusal.
[[nodiscard]] std::optional<Mesh> readMesh(const Document& document, const MeshBinding& binding,
                                           std::span<const Material> materials, std::string& whyEmpty,
                                           Warnings& warnings);

/// Whether a primitive of a skinned node is not skinned, so that it moves with the node.
[[nodiscard]] bool followsNode(const Document& document, uint32_t meshNode);

} // namespace supple::cage::gltf
