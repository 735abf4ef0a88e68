// From split vertices and triangles to the cage: welding, polygons, corners.
#pragma once

#include "cage/leniency.h"
#include "cage/message.h"
#include "cage/parts.h"
#include "cage/split/mesh.h"

namespace supple::cage {

/// Whether the triangles of a mesh are paired into quads (cage/triangle_pairs.h), if its source says nothing of
/// polygons.
enum class Pairing {
    whereClean, ///< if nearly all of them make good quads, as those of a mesh do that was drawn in quads
    always,     ///< all that do not fold
    never
};

namespace split {

/// Fills the cage, its weights, the displacements of its morph targets, and what a part tells of where they came from.
/// The cage has no face if the mesh has only triangles that repeat a vertex. Throws Refusal. Lists of creases and
/// corners that name what is not there are left out by `leniency`, and it gathers what is wrong with tiles of trims.
void buildCage(const Mesh& mesh, Pairing pairing, PartCage& out, Leniency& leniency, Warnings& warnings);

} // namespace split

/// Says what was paired without being asked.
void warnOfPairs(const std::vector<PartCage>& parts, Warnings& warnings);

} // namespace supple::cage
