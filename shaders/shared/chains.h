// The tables and the pool of exact Catmull-Clark patches (what all schemes share: shared/surface.h; docs/catmull_clark.md).
//
// The mesh has quads alone: it is the cage, or what one step of subdivision makes of it. A vertex is plain if the B-spline's own
// formulas hold round it; a quad with four plain corners is a bicubic patch. All other quads are irregular: their quarters are
// leaves, B-spline patches of finer levels.
//
// Coefficient pool: limit points (one a vertex; a plain vertex on creases has one more for each further run of faces between
// them), tangents and face coefficients (one a slot), points of level 1 that irregular quads need; of every vertex that is not
// plain its normals (one a run) and its chain; the vertices of the mesh if it is not the cage. A chain is the vertex's point of
// level 1, then for every level from 2 on all points up to radius 3 round the vertex, as offsets from that.
//
// Tables
//   ring              see shared/surface.h; closed fans come first, and of them those with points
//   fans with points  two words, one behind the other: pool index of the first point of level 1 that the fan makes; which it makes, a
//                     bit each: that of its vertex, from kFanEdges on those of its edges, from kFanFaces on those of its faces. The
//                     points follow each other in this order. Other closed fans have nothing but the ring
//   plain runs        of all others three words, one behind the other: first slot, weights (surface::writeFanWeights), limit point
//   vertices          not plain: two elements: (first word of the net; fan; arrangement; pool index of the limit point), (pool
//                     index of the chain's level 2 or 0, pool index of the first normal, that which the net counts from, pool index
//                     of the centre of level 2 if the chain is made level by level, else 0)
//   blocks            of kBlockLanes lanes: whole chains of one fan, a lane a spoke or a centre: (fan; first vertex; vertices;
//                     last level). Or one level of chains, the first without centres: (fan; first vertex; vertices, and from
//                     kChainLevelShift on the level; first item). The vertex rises first, then the spoke; the centre comes last
//   net               points up to radius 2, in spiral order, 16 bits each
//   fans              by sectors and openness: (sectors, points of a level of a chain, 1 if it is open, 0), (weight of a spoke point,
//                     of a face point in the centre's step; 0, 0); net lists: kNetListElements a sector, the net of 5 x 5 points of a
//                     chain's level, 16 bits each, row by row; the last word has the points of a level and,
//                     from kChainLevelShift on, the last level
//   arrangements      by fan and sharpness: (runs; first word of the sharpness of spokes on level 1, or kNoSharpness; centre steps;
//                     points of ring 1); a run: (blocks, 0, 0, 0), then blocks of an element a point of ring 1: weights in four
//                     vectors, the first of the run being the position, the others tangents along which the sum of the cross
//                     products of neighbours is the normal. Centre steps: an element a level of the chain (smooth, crease,
//                     first spoke, second spoke)
//   irregular quads   kQuadRecordElements: limit points of the corners; their spokes, as bicubic patches have them, or the pool
//                     index of their chain (without one, of what lies behind their normals); net lists of their sector, 0 where
//                     there is no chain; their net, as in a net list: 5 x 5 points of level 1; from kNetListNormals on, how far
//                     before their chains the normals of the corners lie, 0 where they have none; in the last word flags and,
//                     from kNetFirstShift on, the pool index that the points count from. If a side is a crease
//                     (kNetListSharp), an element more: the sharpness of the sides on level 1
#ifndef SUPPLE_SHARED_CHAINS_H
#define SUPPLE_SHARED_CHAINS_H

#include "shaders/shared/portable.h"
#include "shaders/shared/surface.h"

SUPPLE_SHARED_BEGIN

SUPPLE_SHARED_CONST kQuadRecordElements = 7u;
SUPPLE_SHARED_CONST kSharpQuadElements = 8u;
SUPPLE_SHARED_CONST kQuadNetListElement = 2u;
SUPPLE_SHARED_CONST kQuadNetElement = 3u;
SUPPLE_SHARED_CONST kQuadSharpnessElement = 7u;
SUPPLE_SHARED_CONST kNetSide = 5u;
SUPPLE_SHARED_CONST kNetPoints = 25u;
SUPPLE_SHARED_CONST kNetMiddle = 12u;

SUPPLE_SHARED_CONST kChainLevelShift = 24u;

// A kind of fan (shared/surface.h): regular, and makes points of level 1. It comes before other regular ones, whose dispatch
// says in ConstructPush::from how many there are.
SUPPLE_SHARED_CONST kPointsFan = 5u;
SUPPLE_SHARED_CONST kFanEdges = 1u;
SUPPLE_SHARED_CONST kFanFaces = 5u;
SUPPLE_SHARED_CONST kFanPoints = 9u;

// Kinds of the chain kernel: what it makes.
SUPPLE_SHARED_CONST kMakesLimits = 0u;
SUPPLE_SHARED_CONST kMakesFirstLevel = 1u; // of level 1
SUPPLE_SHARED_CONST kMakesLevel = 2u;      // of the level before
SUPPLE_SHARED_CONST kMakesChains = 3u;     // all levels, in workgroup memory: wide mapping
SUPPLE_SHARED_CONST kBlockPoints = 256u;   // of a level, for all chains of a block

SUPPLE_SHARED_CONST kNetListElements = 4u;
SUPPLE_SHARED_CONST kNetListSharp = 25u; // number: 1 if the sharpness of the sides follows
SUPPLE_SHARED_CONST kNetListNormals = 26u; // numbers
SUPPLE_SHARED_CONST kNetListLastWord = 15u;
SUPPLE_SHARED_CONST kNoSharpness = 0xFFFFFFFFu;

// The last word of a record's net: flags, a bit a side, and what the net counts from. 28 bits number the 16-byte vectors of
// any pool.
SUPPLE_SHARED_CONST kCubicSide = 0u; // the border is one cubic, for both ends are plain
SUPPLE_SHARED_CONST kNetFirstShift = 4u;

// Loop (docs/loop.md). Triangles: kLeafPoints pool indices of vertices; limit points of the corners, flags. Irregular ones
// then have, an element each: pool index of the chains of the corners or 0; net lists of their sector; then their net, as quads:
// kTriangleNetPoints points of level 1, normals, in the last word the pool index alone. Net lists are as those of quads. Those
// with semi-sharp creases end with the sharpness of their sides on level 1, 0 of smooth and endless ones.
SUPPLE_SHARED_CONST kLeafPoints = 12u;
SUPPLE_SHARED_CONST kTriangleNetPoints = 18u;
SUPPLE_SHARED_CONST kTriangleNetListElements = 3u;
SUPPLE_SHARED_CONST kTriangleNetListNormals = 18u;
SUPPLE_SHARED_CONST kTriangleNetListLastWord = 11u;
SUPPLE_SHARED_CONST kTriangleElements = 4u;
SUPPLE_SHARED_CONST kIrregularTriangleElements = 9u;
SUPPLE_SHARED_CONST kSharpTriangleElements = 10u;
SUPPLE_SHARED_CONST kTriangleCageElement = 0u;
SUPPLE_SHARED_CONST kTriangleCornerElement = 3u;
SUPPLE_SHARED_CONST kTriangleChainElement = 4u;
SUPPLE_SHARED_CONST kTriangleNetElement = 6u;
SUPPLE_SHARED_CONST kTriangleSharpnessElement = 9u;
// Flags, three bits each: a side is an endless crease; a crease passes a plain corner, along none of the sides; both ends of a
// side are plain; a corner is plain.
SUPPLE_SHARED_CONST kSharpTriangleSide = 0u;
SUPPLE_SHARED_CONST kCreasedTriangleCorner = 3u;
SUPPLE_SHARED_CONST kWholeTriangleSide = 6u;
SUPPLE_SHARED_CONST kPlainTriangleCorner = 9u;
// Cells of a net: at its three corners, and the middle.
SUPPLE_SHARED_CONST kMiddleCell = 3u;

SUPPLE_SHARED_END

// Where a point stands in a quad's own net, as a corner counts them: i along its first edge, j along its second. Both begin at 0,
// one step before the corner.
#define SUPPLE_QUAD_NET_PLACE(corner, i, j)                                                                                     \
    ((corner) == 0u   ? kNetSide * (j) + (i)                                                                                     \
     : (corner) == 1u ? kNetSide * (i) + 4u - (j)                                                                                \
     : (corner) == 2u ? kNetSide * (4u - (j)) + 4u - (i)                                                                         \
                      : kNetSide * (4u - (i)) + (j))
// The point in the middle of a side.
#define SUPPLE_QUAD_SIDE_MIDDLE(side) (0x0B110D07u >> 8u * (side)&255u)

#endif
