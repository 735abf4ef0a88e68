// The subdivision as a scheme: the static tables it makes of a cage.
#pragma once

#include "base/result.h"
#include "surface/recipe.h"
#include "surface/scheme.h"
#include "surface/subdivision/mesh.h"

namespace supple::surface::subdivision {

/// The tables of shaders/shared/{surface,subdivision}.h. `depth`: steps from the cage, at least the isolation steps.
/// Refuses a vertex with so many edges that 16 bits do not number the points of its fragment: "vertex 7 has 260 faces:
/// ...".
[[nodiscard]] Result<Tables> buildTables(const Mesh& mesh, uint32_t depth);

/// See surface::Scheme.
[[nodiscard]] Result<Tables> build(const Recipe& recipe, const cage::Cage& cage);

} // namespace supple::surface::subdivision
