// Queries: bindings, push constants, and the pieces of surfaces that rays are met with.
//
// A piece is a part of a face of the cage, over which the surface is a polynomial of the deformed cage's vertices: a square with
// 4 x 4 Bezier coefficients, u fastest, or a triangle with 15 of degree 4, rows of v, each from u = 0 on. Where the surface is no
// such polynomial, the piece is so small that it comes near enough (runtime/queries/query_pieces.cpp).
//
// Table (uvec4 elements): kPieceElements for each piece, then its vertices and coefficients. Pieces share coefficients.
//   0   face; the kind, and from kPieceVerticesShift on the number of vertices; the element where these begin, four words each;
//       the element where the coefficients begin
//   1   floats: u, v of the part's corner and its size, in the parameters of what the handle is told for; how far
//       coefficients may lie outside the vertices' box, as a part of its size
//   2   floats: a, b of the handle at (0, 0), and what they gain to (1, 0)
//   3   floats: what they gain to (1, 1); then the side of the handle where u >= v, and where u < v
//   4   floats: a, b of the handle at (0, 0) where u < v, and what they gain to (0, 1)
//   5   floats: what they gain to (1, 1); 0, 0
// A square's handle is linear on either side of u = v. A triangle's is that of elements 2 and 4 all over.
//   coefficients   four elements a vertex: its shares of coefficients 0..3, 4..7, 8..11, 12..15
//
// Triangles (words), for hits of what draws the surfaces: a header, then for each surface where its ranges begin and how many
// there are; for each range where its runs of patches begin and how many there are; runs of kTriangleRunWords: the domain of the
// patches, with how often the cage was subdivided and, if the group's rate does not give it, the rate, or kSingleTriangles; how many
// patches there are; where their faces begin; faces, a word a patch; for each face of the cage its
// first piece and how many it has.
//
// Leaves, behind the pieces if there are trees: the pieces in the order of the leaves, four words an element.
//
// Boxes (uvec4 elements): two for each instance of the list, the low and the high corner of its cage as float bits. Beside the low one
// stands 1 if a ray is aimed at the instance; beside the high ones, from the window's first on, the numbers in the list of those that
// rays are aimed at. Then for each window dispatches, an element each, with how many instances they are for: pick; and for each turn
// fit, refit, cast.
#ifndef SUPPLE_SHARED_QUERIES_H
#define SUPPLE_SHARED_QUERIES_H

#include "shaders/shared/instances.h"
#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

// Descriptor bindings, set 0; beside them the list of instances (shared/instances.h).
SUPPLE_SHARED_CONST kPieceBinding = 0u;
SUPPLE_SHARED_CONST kPieceTexelBinding = 1u;
SUPPLE_SHARED_CONST kQueryCageBinding = 2u;
SUPPLE_SHARED_CONST kQueryCageTexelBinding = 3u;
SUPPLE_SHARED_CONST kRayBinding = 4u;      // two vec4 a ray, as SuppleRay has them; then as many a hit, SuppleTriangleHit. Or one a place
SUPPLE_SHARED_CONST kBestBinding = 5u;     // uvec2 a ray or place: bits of the least t, then the lane that has it
SUPPLE_SHARED_CONST kQueryBoxBinding = 6u; // see above
SUPPLE_SHARED_CONST kHitBinding = 7u;      // four uvec4 a ray, as SuppleHit has them
SUPPLE_SHARED_CONST kTriangleBinding = 8u;
SUPPLE_SHARED_CONST kTreeBinding = 9u; // shaders/queries/tree.glsl
SUPPLE_SHARED_CONST kTreeTexelBinding = 10u;

SUPPLE_SHARED_CONST kPieceElements = 6u;
SUPPLE_SHARED_CONST kPieceVerticesShift = 8u;
SUPPLE_SHARED_CONST kSquarePiece = 0u;
SUPPLE_SHARED_CONST kTrianglePiece = 1u;
SUPPLE_SHARED_CONST kPieceCoefficients = 16u;

SUPPLE_SHARED_CONST kTriangleSurfaces = 0u;   // how many
SUPPLE_SHARED_CONST kTriangleFaces = 1u;      // of the cage
SUPPLE_SHARED_CONST kTriangleFacePieces = 2u; // where they begin
SUPPLE_SHARED_CONST kTriangleHeaderWords = 3u;
SUPPLE_SHARED_CONST kTriangleRunWords = 3u;
SUPPLE_SHARED_CONST kTriangleStepsShift = 8u;
SUPPLE_SHARED_CONST kTriangleRateShift = 16u; // 0: of the group
SUPPLE_SHARED_CONST kSingleTriangles = 0xFFu; // patches that are triangles of the cage, at any rate

SUPPLE_SHARED_CONST kNothingMet = 0xFFFFFFFFu;
SUPPLE_SHARED_CONST kRaysPerLane = 16u;

SUPPLE_SHARED_CONST kTreeDispatches = 3u; // of a turn

// What a dispatch of the pick kernel does, or of the one that finds nearest points.
SUPPLE_SHARED_CONST kFindLeast = 0u; // the least t of each ray
SUPPLE_SHARED_CONST kFindOwner = 1u; // the first lane that has it
SUPPLE_SHARED_CONST kFindBound = 2u; // nearest points: how near some point must be

struct QueryPush {
    uint pieceCount;
    uint firstEntry;    // of the window, in the list of instances
    uint instanceCount; // refine: slots of the window
    uint cageStride;    // vertices from one instance to the next
    uint vertexCount;   // of a cage
    uint firstRay;
    uint rayCount;      // behind the last
    uint firstBox;      // of the window, counted in instances
    uint firstLane;     // of the window, among the lanes of all windows that may own a hit
    uint work;          // kFindLeast, kFindOwner or kFindBound
    uint group;         // its number in the pool
    uint firstSlot;     // of the window
    uint firstTriangle; // refine: the first hit of a triangle, in rays
    uint rate;          // refine: of the group, along an edge of the cage
    uint writesMisses;  // 1: of all windows this one writes the rays that meet nothing
    float reach;        // the largest of the pieces
    uint firstDispatch; // of the window, an element of the boxes
    uint treeCount;     // how many instances have trees at a time
    uint turns;         // after which all instances that rays are aimed at have had one; 0: there are no trees
    uint turn;
    uint firstLeaf;     // element of the pieces
};

SUPPLE_SHARED_END

#endif
