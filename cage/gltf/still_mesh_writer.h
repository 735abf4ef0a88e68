// A mesh that nothing deforms, of a GLB that is being written. Private to cage/gltf/.
#pragma once

#include "cage/gltf/packer.h"
#include "cage/gltf/writer.h"
#include "cage/still_mesh.h"

namespace supple::cage::gltf {

/// One primitive per entry of the mesh's faces. The character says how many UV sets the materials need. Counts vertices
/// in `file`.
[[nodiscard]] json writeStillMesh(const StillMesh& mesh, const Character& character, Packer& packer, GlbFile& file);

} // namespace supple::cage::gltf
