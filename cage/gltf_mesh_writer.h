// The mesh of a GLB that is being written. Private to cage/.
#pragma once

#include "cage/character.h"
#include "cage/gltf_message.h"
#include "cage/gltf_packer.h"

#include <cstdint>

namespace supple::cage {

struct WrittenMesh {
    json mesh;
    uint32_t vertexCount = 0; ///< of all primitives
};

/// One primitive a material. Its vertices are the distinct corners of its faces, in the cage's order; its triangles
/// follow FB_ngon_encoding; the polygons themselves, with creases, sharp vertices and holes, go into SUPPLE_mesh_cage
/// (docs/SUPPLE_mesh_cage.md). Skinned: with JOINTS_n and WEIGHTS_n.
[[nodiscard]] WrittenMesh writeMesh(const Character& character, bool skinned, GltfPacker& packer, Warnings& warnings);

} // namespace supple::cage
