// From a glTF file's vertices and triangles to the cage: welding, polygons, corners. Private to cage/.
#pragma once

#include "cage/character.h"
#include "cage/gltf_mesh.h"
#include "cage/gltf_reader.h"

namespace supple::cage {

/// Fills the cage, its weights, the displacements of its morph targets, and what a character tells of where they came
/// from. Throws Refusal.
void buildCage(const GltfDocument& document, const GltfMesh& mesh, const GltfOptions& options, Character& out);

} // namespace supple::cage
