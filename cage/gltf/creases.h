// Creases and sharp vertices of a glTF file. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/gltf/mesh.h"
#include "cage/message.h"

#include <cstdint>
#include <span>

namespace supple::cage::gltf {

/// Fills the cage's creases and sharp vertices: of each kind those of SUPPLE_mesh_cage, or else of the mesh's extras.
/// Throws Refusal when the extension names what is not there; extras are only warned about. `cageVertices` gives the
/// cage vertex of each of the mesh's vertices, kNone where it is left out.
void readCreases(const Document& document, const Mesh& mesh, std::span<const uint32_t> cageVertices, Cage& cage,
                 Warnings& warnings);

} // namespace supple::cage::gltf
