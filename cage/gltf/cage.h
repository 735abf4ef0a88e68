// From a glTF file's vertices and triangles to the cage: welding, polygons, corners. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/mesh.h"
#include "cage/gltf/reader.h"

namespace supple::cage::gltf {

/// Fills the cage, its weights, the displacements of its morph targets, and what a character tells of where they came
/// from. Throws Refusal.
void buildCage(const Document& document, const Mesh& mesh, const GltfOptions& options, Character& out);

} // namespace supple::cage::gltf
