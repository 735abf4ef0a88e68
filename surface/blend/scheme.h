// The blending surface as a scheme: the static tables it makes of a cage.
#pragma once

#include "base/result.h"
#include "surface/blend/mesh.h"
#include "surface/recipe.h"
#include "surface/scheme.h"

namespace supple::surface::blend {

/// The tables of shaders/shared/{surface,blend}.h. `rate`: segments along a patch edge; 0: for samples at any
/// parameters. O(corners + classes rate^2).
[[nodiscard]] Tables buildTables(const Mesh& mesh, uint32_t rate);

/// See surface::Scheme.
[[nodiscard]] Result<Tables> build(const Recipe& recipe, const cage::Cage& cage);
[[nodiscard]] float boundsMargin(const cage::Cage& cage);

} // namespace supple::surface::blend
