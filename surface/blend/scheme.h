// The blending surface as a scheme: the static tables it makes of a cage.
#pragma once

#include "surface/blend/mesh.h"
#include "surface/scheme.h"

namespace supple::surface::blend {

/// The tables of shaders/shared/{surface,blend}.h for patches of `rate` segments an edge, or, where it is 0, for
/// samples at any parameters. O(corners + classes rate^2).
[[nodiscard]] Tables buildTables(const Mesh& mesh, uint32_t rate);

} // namespace supple::surface::blend
