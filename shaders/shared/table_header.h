// The head of a block of tables: where its sections lie in it and in an instance's coefficient pool. Kernels read it, so that a
// dispatch is told no more than its own range. What tables do not have is 0.
#ifndef SUPPLE_SHARED_TABLE_HEADER_H
#define SUPPLE_SHARED_TABLE_HEADER_H

#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

SUPPLE_SHARED_CONST kTableHeaderBinding = 22u; // set 0 of all surface layouts

struct TableHeader {
    uint words;      // of the block, this header included
    uint cageStride; // vertices an instance in the deformed cage
    uint patchCount; // of all ranges

    // In an instance's pool:
    uint poolStride; // coefficients an instance
    uint meshVertices; // first vertex of the mesh, where steps of subdivision made it
    uint tangents;   // first tangent
    uint faces;      // first face coefficient
    uint inner;      // p-rep: first coefficient of the perturbed edges
    uint frames;     // polygons: first tangent frame
    uint depth;      // levels of detail: the last level of its chains

    // In the tables:
    uint ring;            // first word of the ring
    uint edgeClasses;     // p-rep, P_m: first element of the edges' weights
    uint coordinates;     // blending surface: first element of the coordinates of samples
    uint directions;      // polygons with tangents: first word of their directions
    uint attributes;      // first element of the corner attributes
    uint attributeHalves; // 1 where a word holds the numbers of two corners
    uint uvSets;          // 1 or 2
    uint faceUvs;         // 1 where corners have a place in their face's trim tile
    uint levelPatches;    // levels of detail: first element of the patches
    uint depthLanes;      // levels of detail: the element of how many lanes make each depth of chains

    // Levels of detail: counts, and what lies where in an instance's scratch (shared/lod.h).
    uint runCount;      // runs of patches
    uint edgeCount;     // edges
    uint scratchStride; // elements an instance; fragments too
    uint depths;        // first of kDepthWords; 0: there are no chains
};
SUPPLE_SHARED_CONST kTableHeaderWords = 24u; // whole elements

SUPPLE_SHARED_END

#endif
