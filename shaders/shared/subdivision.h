// The tables and the scratch buffer of the subdivision (what all schemes share: shared/surface.h; the words and
// rules: docs/subdivision.md).
//
// Coefficient pool: the vertices of the isolated level.
// Scratch buffer: vec4 elements, TableHeader::scratchStride an instance; for every step and class of fragments one run of points,
// point by point, in each the fragments of the class.
//
// A class is all fragments of one kind: vertex or facet, sectors, open or closed, with or without sharpness.
//
// Tables
//   stencil weights    one a vertex of a row, four an element, the first being 0; rows with the same weights share them
//   stencil blocks     of kBlockLanes lanes: (first word of its rows, words of a row, rows, pairs of vertices of a row). The rows of
//                      a block have as many vertices
//   stencil rows       its own number, how many elements before the blocks its weights lie, then its vertices in pairs. A number
//                      has 16 bits if that is enough for all (kHalfWords), else a word (kWholeWords). The exact schemes have
//                      stencils, too, and the blending surface where its cage takes a step of subdivision first
//   pattern rows       one element a point, 16 bits a source: s0..s6 and rule | (spoke + 1) << 2
//   neighbors         one element a point, 8 x 16 bits
//   limit rows         two elements a sample: 8 neighbors x 16 bits; (point, spoke + 1, sector | turns from the first
//                      neighbor to the sector's first edge << kTurnShift | kRightSide, sample of the sector); those that no strip
//                      holds come first
//   row lists          one word a point of a level: pattern rows that no cell makes, rising
//   cells              one element a cell, 16 bits each: the points it makes (kNoTarget: none), and its own
//   strips             one element a strip: (first column, columns, sector, 0); a column is an element: (point before |
//                      point of the strip << 16, point behind | sample << 16, kNoSample or Loop's axis, 0)
//   masks              (kCornerMask, kWholeMask or 0, first sector, sectors, points of ring 1), then one element a point of ring 1:
//                      (position, first tangent, second tangent, 0); one an arrangement of sharp spokes and run
//   class words        [point][fragment] net: pool indices; [spoke][fragment] sharpness; [sector][fragment] patches or
//                      kNoPatch; [sector][fragment] mask elements
//   centre steps       [step][fragment] elements: (smooth, crease, first spoke, second spoke); of classes with sharpness
//   class headers      (fragments, sectors | flags, net, sharpness), (patches, masks, centre steps, 0), (weight of a spoke point,
//                      of a face point, limit row, limit rows), then one a level 0..steps: (pattern rows of the level, neighbors
//                      on it, points, its run in the scratch buffer)
//   blocks             kBlockLanes lanes of one class, step and kind of work each, three elements: (first cell, pattern
//                      row, strip or limit row; row list's first word or the class's patches; first place in the list;
//                      first fragment), (run read, run written, fragments, places), (neighbors on the level before,
//                      class header, 0, 0); the fragment rises first
//   fragments          (class header, fragment, 0, 0)
#ifndef SUPPLE_SHARED_SUBDIVISION_H
#define SUPPLE_SHARED_SUBDIVISION_H

#include "shaders/shared/portable.h"
#include "shaders/shared/window.h"

SUPPLE_SHARED_BEGIN

// Rules of a pattern row; values of surface::subdivision::Rule.
SUPPLE_SHARED_CONST kVertexRule = 0u;
SUPPLE_SHARED_CONST kEdgeRule = 1u;
SUPPLE_SHARED_CONST kFaceRule = 2u;
SUPPLE_SHARED_CONST kCentreRule = 3u;

SUPPLE_SHARED_CONST kSharpClass = 0x80000000u; // flags of a class header
SUPPLE_SHARED_CONST kRightSide = 0x80000000u;
SUPPLE_SHARED_CONST kTurnShift = 28u; // 3 bits
SUPPLE_SHARED_CONST kSectorMask = (1u << kTurnShift) - 1u;
SUPPLE_SHARED_CONST kCornerMask = 0x80000000u;
SUPPLE_SHARED_CONST kWholeMask = 0x40000000u; // of all sectors round a smooth vertex
SUPPLE_SHARED_CONST kNoPatch = 0xFFFFFFFFu;
SUPPLE_SHARED_CONST kBlockLanes = 32u;

// Kinds of the kernel that makes points by stencils: what a number takes.
SUPPLE_SHARED_CONST kHalfWords = 0u;
SUPPLE_SHARED_CONST kWholeWords = 1u;

// Kinds of work. A cell is a point with its ring: it makes the points of the next level that the ring suffices for. A
// strip is a row of samples of a sector, each loading but the points the one before had not. Both do without sharpness
// and centres; what has those, and what no cell or strip holds, goes row by row and sample by sample.
SUPPLE_SHARED_CONST kInBulk = 0u; // cells, strips
SUPPLE_SHARED_CONST kOneByOne = 1u;
SUPPLE_SHARED_CONST kWorkKinds = 2u;

// The level that a step reads: the scratch buffer's; the isolated one; that, where previous positions are asked for and
// instances without a past take today's.
SUPPLE_SHARED_CONST kFromScratch = 0u;
SUPPLE_SHARED_CONST kFromNet = 1u;
SUPPLE_SHARED_CONST kFromPastNet = 2u;
SUPPLE_SHARED_CONST kSources = 3u;

SUPPLE_SHARED_CONST kCellTargets = 7u;
// The points a cell makes, by neighbor: its own vertex point, then the edge points (Loop: all, Catmull-Clark:
// neighbors 0, 2, 6) and face points (Catmull-Clark: 1, 7) towards them.
#define SUPPLE_SUBDIVISION_QUAD_SLOTS 0u, 1u, 2u, 6u, 7u
SUPPLE_SHARED_CONST kNoTarget = 0xFFFFu;
SUPPLE_SHARED_CONST kNoSample = 0xFFFFFFFFu;
SUPPLE_SHARED_CONST kClassHeaderElements = 3u; // before the levels

struct FragmentPush {
    WindowPush window;
    uint table; // first block or fragment; polygons: first vertex
    uint count; // of them an instance
    uint step;  // the level that is written, or, for the limit, that is read
    uint verticesPerInstance;
    uint samples;     // of a sector
    uint firstVertex; // of the patches, within an instance
    uint today; // 1: instances without a past come from the coefficients of this frame (kTodaysPoolBinding)
};

SUPPLE_SHARED_END

#endif
