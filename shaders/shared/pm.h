// The tables and the pool of P_m (what all schemes share: shared/surface.h). Numbers in parentheses are the equations of
// docs/pm.md.
//
// Coefficient pool: limit points v (one a sector), tangent points t_j and face coefficients f_j (one a slot of a sector
// each), then what the facet stage adds: polar patches h12, h22; P_m patches b004, then b211 b121 b112 a sector.
//
// Tables
//   sector records   (cage vertex, first slot, element of the weights, sector): regular, then smooth, then creased ones
//   ring             three words a slot: far end of edge j, the two far corners of facet j (a quad's twice; a triangle's two
//                    edge ends); at an open sector's last slot the vertex itself
//   smooth weights   (facets | kOpenSector, 0, 0, 0), then two elements a slot: (limitEdge, limitFace, e1Edge, e1Face),
//                    (e2Edge, e2Face, cosine, sine); one a kind and count of facets
//   creased weights  (facets | kOpenSector | kCornerSector | kPinnedSector, limit scale, tangent scale, 0), then one element a slot:
//                    (alpha, cosine, sine, 0); one a sector
//   polar facets     two elements: pool indices (v, h02, h32, h12), (c, 3/2 alpha of h02, 3/2 alpha of h32, 0)
//   P_m facets       two elements a corner i: pool indices (v_i, t0, t1, f), (f across edge i, f across edge i - 1,
//                    edge class element, b004); where an edge ends the sector, `across` is its tangent point
//   edge classes     two elements (20): (chi0 / 4 mu, (2 mu - chi1) / 8 mu, factor of f - f_across at v_0, same at v_1),
//                    (chi1 / 4 mu, (2 mu - chi0) / 8 mu, 0, 0)
//   P_m patches      one element a corner i: pool indices (v_i, t0, t1 of corner i + 1, x); x is b004 for i = 0, and for
//                    i = 1 a bit a corner whose normal is taken a step inside
#ifndef SUPPLE_SHARED_PM_H
#define SUPPLE_SHARED_PM_H

#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

// Kinds of sectors: specialization of pm/vertex.comp.
SUPPLE_SHARED_CONST kPmRegularSector = 0u; // closed, four facets, no crease
SUPPLE_SHARED_CONST kPmSmoothSector = 1u;
SUPPLE_SHARED_CONST kPmCreasedSector = 2u;

SUPPLE_SHARED_CONST kOpenSector = 0x80000000u;
SUPPLE_SHARED_CONST kCornerSector = 0x40000000u;
SUPPLE_SHARED_CONST kPinnedSector = 0x20000000u; // moved so that v is the vertex

SUPPLE_SHARED_END

// k0 and k1 of (3) for facets of m sides.
#define SUPPLE_PM_RAY_SIDE(m) ((m) == 5u ? 0.7236067977499790 : (m) == 4u ? 0.5 : 1.0 / 3.0)
#define SUPPLE_PM_RAY_MIDDLE(m) ((m) == 5u ? -0.4472135954999579 : (m) == 4u ? 0.0 : 1.0 / 3.0)

#endif
