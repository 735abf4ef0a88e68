// A mesh that nothing deforms, of a GLB that is being written. Private to tools/gltf/.
#pragma once

#include "cage/still_mesh.h"
#include "tools/gltf/packer.h"
#include "tools/gltf/writer.h"

namespace supple::cage::gltf {

/// One primitive per entry of the mesh's faces. The character says how many UV sets the materials need. Counts vertices
/// in `file`.
[[nodiscard]] json writeStillMesh(const StillMesh& mesh, const Character& character, Packer& packer, GlbFile& file);

} // namespace supple::cage::gltf
