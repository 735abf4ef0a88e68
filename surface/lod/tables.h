// What level of detail adds to a scheme's tables: the edges of patches, and which edges a patch has.
#pragma once

#include "surface/lod/grid.h"
#include "surface/patch_edges.h"
#include "surface/scheme.h"

namespace supple::surface::lod {

/// Appends edges and patches to `tables` (Tables::lod) in the layout of shaders/shared/lod.h. Two patches share an edge
/// if their scheme says so. Across a crease they may have one each. These have coefficients of equal value, and
/// therefore equal levels.
void appendTables(const PatchEdges& edges, Tables& tables);

} // namespace supple::surface::lod
