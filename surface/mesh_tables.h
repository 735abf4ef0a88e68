// What an indexed mesh adds to a scheme's tables: edges and corners whose samples patches share
// (surface/indexed_mesh.h).
//
// Two patches share the samples of an edge if they compute the same curve and the same normals along it
// (surface/patch_edges.h) and have the same corner attributes at both ends. Likewise for a corner. Samples that merely
// lie in the same place are not shared, for example on the two sides of a crease.
#pragma once

#include "surface/patch_edges.h"
#include "surface/scheme.h"

namespace supple::surface {

/// Appends the edges to `tables` (Tables::mesh). `attributes`: the tables have corner attributes. `tangents`: with
/// these, faces whose texture coordinates turn in different directions share no sample, because their frames have
/// different signs.
void appendMeshTables(const PatchEdges& edges, bool attributes, bool tangents, Tables& tables);

} // namespace supple::surface
