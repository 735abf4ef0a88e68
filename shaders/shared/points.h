// Points of surfaces: bindings, push constants and the layout of a point set's table.
//
// Table (uvec4 elements): a header for each block of 64 points, then the weights of the blocks.
//   header     (first element of the block, weights of each of its points, points of the block, 0)
//   weight     (cage vertex; its share of the position, of A and of B as float bits)
// Weight i of point k of a block of n points stands at first + i * n + k. The first weight of a point is that of its
// heaviest vertex, and all others act on differences to it. A point with fewer weights than the block has is filled up
// with its first vertex and shares of 0.
//
// A and B are the point's tangent and bitangent of the bind pose, carried along by the deformation. They lie in the
// tangent plane, and A x B points outwards. In tables of derivatives they are the derivatives by the two numbers of the
// point.
//
// Points on surface vertices (uvec2): the number of the point, and that of the vertex in an instance. They stand together by surface
// and rate.
#ifndef SUPPLE_SHARED_POINTS_H
#define SUPPLE_SHARED_POINTS_H

#include "shaders/shared/instances.h"
#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

// Descriptor bindings, set 0. What is only read is bound twice: GPUs load it as a storage buffer, CPU devices as
// texels.
SUPPLE_SHARED_CONST kPointTableBinding = 0u;
SUPPLE_SHARED_CONST kPointTableTexelBinding = 1u;
SUPPLE_SHARED_CONST kPointCageBinding = 2u;
SUPPLE_SHARED_CONST kPointCageTexelBinding = 3u;
SUPPLE_SHARED_CONST kPointBinding = 4u;     // what the pass writes for the host
SUPPLE_SHARED_CONST kPointPastBinding = 5u; // a vec4 for each point: where it was
SUPPLE_SHARED_CONST kPointVertexBinding = 6u;   // surface vertices
SUPPLE_SHARED_CONST kVertexPointBinding = 7u;   // the points on them

SUPPLE_SHARED_CONST kPointBlock = 64u;

// SupplePointFormat.
SUPPLE_SHARED_CONST kPointFrame48 = 0u;
SUPPLE_SHARED_CONST kPointFrame64 = 1u;
SUPPLE_SHARED_CONST kPointVertex16 = 2u;
SUPPLE_SHARED_CONST kPointDerivatives32 = 3u;
SUPPLE_SHARED_CONST kPointFormats = 4u;
// The elements of 16 bytes that a point takes.
SUPPLE_SHARED_FUNCTION uint pointElements(uint format) {
    return format == kPointFrame48 ? 3u : format == kPointFrame64 ? 4u : format == kPointDerivatives32 ? 2u : 1u;
}

struct PointPush {
    uint pointCount;
    uint firstInstance; // of the window, in the list of instances
    uint instanceCount;
    uint cageStride; // vertices from one instance to the next
    // What a descriptor reaches of the window: these slots.
    uint firstSlot;
    uint slotCount;
    uint firstElement;         // of 16 bytes, where the first of these slots begins
    uint firstPast;            // the same where points were
    uint isFirst;              // 1: no point has a past
    float pastX, pastY, pastZ; // how far the origin of the coordinates has moved since the frame before
};

// For points on surface vertices. What has the same name is as above.
struct VertexPointPush {
    uint pointCount;
    uint firstInstance;
    uint instanceCount;
    uint firstSlot;
    uint slotCount;
    uint firstElement;
    uint firstPast;
    uint isFirst;
    uint firstEntry; // of the surface at its rate
    uint entryCount;
    uint instanceWords; // from one instance's vertices to the next
    uint vertexWords;   // from one vertex to the next
};

SUPPLE_SHARED_END

#endif
