// What level of detail adds to a scheme's tables: the edges of patches, and which edges a patch has.
#pragma once

#include "surface/lod/grid.h"
#include "surface/scheme.h"

namespace supple::surface::lod {

/// Appends edges and patches to `tables` (Tables::lod) in the layout of shaders/shared/lod.h. Two patches share an edge
/// if they share all coefficients of its border cubic, or its two halves, or its charts and spokes. Across a crease
/// they may not. There both edges have coefficients of equal value, and therefore equal levels.
void appendTables(Tables& tables);

} // namespace supple::surface::lod
