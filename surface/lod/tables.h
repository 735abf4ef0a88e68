// What level of detail adds to a scheme's tables: which edges there are, and which edges a patch has.
#pragma once

#include "surface/lod/grid.h"
#include "surface/scheme.h"

namespace supple::surface::lod {

/// The form of a class of patches that has levels (surface::hasLevels).
[[nodiscard]] Form formOf(PatchClass patchClass);

/// Appends edges and patches to `tables` (Tables::lod), as shaders/shared/lod.h has them. Edges are found by the
/// coefficients of their boundary cubic, or by their charts and spokes: two patches that share all of these share the
/// edge. Where they do not, as across a crease, the coefficients have the same values, and so have the edges' levels.
void appendTables(Tables& tables);

} // namespace supple::surface::lod
