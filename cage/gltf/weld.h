// Which of a glTF mesh's vertices are one cage vertex. Private to cage/gltf/. All of these throw Refusal.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/gltf/mesh.h"
#include "cage/message.h"
#include "cage/weld.h"

#include <cstdint>
#include <vector>

namespace supple::cage::gltf {

struct MeshWelding {
    Welding welding;
    WeldSource source = WeldSource::equality;
};

/// The cage vertices the mesh gives, else the merges of EXT_mesh_manifold, else by sewing `faces` where position, skin
/// and morph targets are equal. What the file merges itself must agree in position; where skin or morph targets differ
/// there is a warning.
[[nodiscard]] MeshWelding weldMesh(const Document& document, const Mesh& mesh, const Polygons& faces,
                                   Warnings& warnings);

} // namespace supple::cage::gltf
