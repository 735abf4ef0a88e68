// Creases and sharp vertices in a mesh's extras. Private to cage/gltf/.
#pragma once

#include "cage/gltf/json.h"
#include "cage/gltf/mesh.h"
#include "cage/message.h"

#include <string>

namespace supple::cage::gltf {

/// Fills the mesh's own lists, of extras.creases, [vertex, vertex, sharpness], and extras.corners, [vertex, sharpness].
/// extras may hold anything: nothing in them is an error. `isCounted`: the mesh has the vertices of all primitives that
/// are drawn. If some are missing, the numbers in the lists may mean other vertices, and the lists are left out with a
/// warning.
void readExtrasCreases(const Json& fileMesh, bool isCounted, Mesh& mesh, Warnings& warnings);

} // namespace supple::cage::gltf
