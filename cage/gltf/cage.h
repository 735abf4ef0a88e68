// From a glTF file's vertices and triangles to the cage: welding, polygons, corners. Private to cage/gltf/.
#pragma once

#include "cage/gltf/mesh.h"
#include "cage/gltf/reader.h"
#include "cage/message.h"
#include "cage/parts.h"

namespace supple::cage::gltf {

/// Fills the cage, its weights, the displacements of its morph targets, and what a part tells of where they came from.
/// The cage has no face if the mesh has only triangles that repeat a vertex. Throws Refusal.
void buildCage(const Document& document, const Mesh& mesh, const GltfOptions& options, PartCage& out,
               Warnings& warnings);

} // namespace supple::cage::gltf
