// The mesh of a GLB that is being written. Private to tools/gltf/.
#pragma once

#include "tools/gltf/packer.h"
#include "tools/gltf/writer.h"

#include <glm/glm.hpp>
#include <span>

namespace supple::cage::gltf {

/// One primitive a material. Its vertices are the distinct corners of its faces, in the cage's order; its triangles
/// follow FB_ngon_encoding; the polygons themselves, with creases, sharp vertices and holes, go into SUPPLE_mesh_cage
/// (docs/SUPPLE_mesh_cage.md). Skinned: with JOINTS_n and WEIGHTS_n. Counts its vertices and warns in
/// `file`. The character has one part; `normals`: per corner of its cage.
[[nodiscard]] json writeMesh(const Character& character, bool skinned, std::span<const glm::vec3> normals,
                             Packer& packer, GlbFile& file);

} // namespace supple::cage::gltf
