// What supple bake has evaluated, as binary PLY.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "tools/supple/baked_mesh.h"

#include <cstddef>
#include <span>
#include <vector>

namespace supple::tools {

/// One list of vertices and one of faces, mesh after mesh, little endian. Vertices are x y z nx ny nz; then s t, with t
/// upwards as programs that read PLY expect; then red green blue alpha in sRGB. Comments in the header say which faces
/// are which part's. The error: more vertices than PLY's indices count.
[[nodiscard]] Result<std::vector<std::byte>> plyOf(std::span<const BakedMesh> meshes, const cage::Character& character);

} // namespace supple::tools
