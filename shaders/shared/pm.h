// The tables and the pool of P_m (what all schemes share: shared/surface.h). Numbers in parentheses are the equations
// of docs/pm.md.
//
// Coefficient pool: limit points v (one a sector), tangent points t_j and face coefficients f_j (one a slot of a sector
// each), then what the facet stage adds: polar patches h12, h22; P_m patches b004, then b211 b121 b112 a sector.
//
// Tables
// Limit points are numbered as the cage's vertices are, a vertex's first sector with its vertex; other sectors' come
// behind.
//   ring             see shared/surface.h; regular sectors come first and have nothing else; of a triangle the far corners are
//                    its two edges' ends
//   sector records   of all others three words, one behind the other: first slot, element of the weights, limit point; smooth,
//                    then creased ones
//   smooth weights   (facets | kOpenSector, 0, 0, 0), then two elements a slot: (limitEdge, limitFace, e1Edge, e1Face),
//                    (e2Edge, e2Face, cosine, sine); one a kind and count of facets
//   creased weights  (facets | kOpenSector | .. | kOwnEndsSector, limit scale, tangent scale, 0), then one element a slot: (alpha,
//                    cosine, sine, rim); with kOwnEndsSector then one for either end: (1 + slot of the other edge of a smooth
//                    curve or 0, factors of the own edge and of that edge, 0); one a sector
//   variable weights as creased ones, but for the rim, which the kernel finds: in its place the edge's crease set + 1 or 0, and
//                    kGivenAlpha
//   apex classes     (c, 3/2 alpha of h02, 3/2 alpha of h32, their crease sets + 1 or 0: of h32 from kBackSetShift on); polar
//                    patches have the element as their fourth spoke
//   edge classes     two elements (20): (chi0 / 4 mu, (2 mu - chi1) / 8 mu, factor of f - f_across at v_0, same at v_1), (chi1 /
//                    4 mu, (2 mu - chi0) / 8 mu, 0, 0)
//   P_m patches      m - 1 elements, words as the macros below say: of every corner its limit point and its spoke, as in the
//                    records of bicubic patches; b004, and in the bits above one a corner whose normal is taken a step inside;
//                    the numbers of the edges' classes, three a word. With the limit point: whether the edge to the last corner
//                    ends the sector, and the step from the spoke to the one whose facet lies across the edge to the next corner,
//                    0 where that edge ends the sector
#ifndef SUPPLE_SHARED_PM_H
#define SUPPLE_SHARED_PM_H

#include "shaders/shared/portable.h"
#include "shaders/shared/surface.h"

SUPPLE_SHARED_BEGIN

SUPPLE_SHARED_CONST kOpenSector = 0x80000000u;
SUPPLE_SHARED_CONST kCornerSector = 0x40000000u;
SUPPLE_SHARED_CONST kPinnedSector = 0x20000000u; // moved so that v is the vertex
SUPPLE_SHARED_CONST kStraightSector = 0x10000000u; // v is the vertex, and the two ends are one smooth curve
SUPPLE_SHARED_CONST kOwnEndsSector = 0x08000000u; // the tangents at its ends have factors of their own
SUPPLE_SHARED_CONST kSectorFacets = 0x07FFFFFFu;

// Edges of variable sectors.
SUPPLE_SHARED_CONST kAlphaSetMask = 0xFFu;
SUPPLE_SHARED_CONST kGivenAlpha = 0x100u; // the cage gives the alpha, not a sharpness: it is smooth at rims
SUPPLE_SHARED_CONST kBackSetShift = 16u;

// Words of P_m patches.
SUPPLE_SHARED_CONST kEndsBehind = 1u << kPointBits;
SUPPLE_SHARED_CONST kInnerBits = SUPPLE_INNER_BITS; // b004: a pool has fewer coefficients than that
SUPPLE_SHARED_CONST kEdgeClassBits = 10u;
SUPPLE_SHARED_CONST kMaxPmEdgeClasses = 1u << kEdgeClassBits;

SUPPLE_SHARED_END

#define SUPPLE_ACROSS_STEP(pointWord) (int(pointWord) >> int(kSpokeBits))
#define SUPPLE_EDGE_CLASS(word, i) ((word) >> kEdgeClassBits * ((i) % 3u) & (kMaxPmEdgeClasses - 1u))

// A word of a record, of edge i and of m corners. The words that evaluation reads stand in shaders/supple_patch_layout.h.
#define SUPPLE_PM_CLASS_WORD(m, i) (((m) == 5u ? 11u : (m) == 4u ? 9u : 7u) + (i) / 3u)

#endif
