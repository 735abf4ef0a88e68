// The tables and the pool of p-rep (what all schemes share: shared/surface.h).
//
// Coefficient pool: limit points X (one a cage vertex), tangents TG and face coefficients FC (one a spoke slot each),
// edge coefficients H (four a perturbed edge: h20, h30, h21, h31 in the edge's own direction), four zeros. The FC slot
// of a boundary fan's last spoke carries no sector; it holds the vertex normal e1 x e2.
//
// Tables
//   ring             see shared/surface.h; regular interior vertices come first and have nothing else
//   vertex records   of all others two words, one behind the other: first spoke slot, class element
//   classes          (sectors | kBoundaryClass, 0, 0, 0), then two elements a spoke:
//                    (limitEdge, limitFace, e1Edge, e1Face), (e2Edge, e2Face, cosine, sine)
//   edge records     one element: for A, then for B, the vertex and in the bits above half of the edge class's number; then the
//                    edge's spoke there, and the step to the one before it, whose sector is on the edge's other side
//   edge classes     six elements, for A, tA, tB, B, SA, SB: their weights in (h20, h30, h21, h31)
//   perturbed patch  behind the corners a word an edge: the pool index of its H, or of the zeros with kStillEdgeOfPatch;
//                    kReversedEdgeOfPatch where the patch runs against the edge's own direction, which swaps h20 with h30 and h21
//                    with h31
//
// Tables with fan records (surface::Recipe::fanRecords) have instead of X, TG and FC what these are made of, 48 bytes a vertex:
// kFanRecordElements elements with the vertex of the cage, the limit point relative to it, and the tangents e1 and e2, 12 floats one
// behind the other. Whoever reads a corner makes its offsets (surface/fan_record.glsl). Then
//   turns            by class of fans, one element a facet: cosine and sine of its spoke, and of the next one
//   patch records    have in the place of a spoke the corner's turn, an element, with kBorderSpoke and kBorderNextSpoke where a spoke is
//                    the border of an open fan
//   corner normals   name the vertex
//   edge records     two elements: A and its turn, as above, B and its turn; then the other corners of the patch that runs from A to B,
//                    behind B, and of the other one, behind A
#ifndef SUPPLE_SHARED_PREP_H
#define SUPPLE_SHARED_PREP_H

#include "shaders/shared/portable.h"
#include "shaders/shared/surface.h"

SUPPLE_SHARED_BEGIN

SUPPLE_SHARED_CONST kBoundaryClass = 0x80000000u;

SUPPLE_SHARED_CONST kReversedEdgeOfPatch = 0x80000000u;
SUPPLE_SHARED_CONST kStillEdgeOfPatch = 0x40000000u;
SUPPLE_SHARED_CONST kEdgeOfPatchMask = SUPPLE_PREP_EDGE_MASK;

SUPPLE_SHARED_CONST kEdgeClassElements = 6u;

SUPPLE_SHARED_CONST kFanRecordElements = 3u;
SUPPLE_SHARED_CONST kBorderSpoke = 0x80000000u;
SUPPLE_SHARED_CONST kBorderNextSpoke = 0x40000000u;
SUPPLE_SHARED_CONST kTurnMask = 0x3FFFFFFFu;

SUPPLE_SHARED_END

#define SUPPLE_PREP_EDGE_CLASS(wordA, wordB) ((wordA) >> kPointBits | (wordB) >> kPointBits << (32u - kPointBits))

#endif
