// The tables of the blending surface (what all schemes share: shared/surface.h; the formulas: docs/blend.md). They are
// made for one rate, or for none where patches are drawn at levels of detail: then there are neither coordinates nor
// samples.
//
// Coefficient pool: where the cage takes a step of subdivision first, its vertices; then kChartCoefficients a chart:
// c_ab at 3 a + b, the first a position and the others vectors.
//
// Tables
//   chart records    (vertex, first ring word, element of the fit, pool index of c_00), by number of ring points
//   ring             words: vertices of the cage, or, where it is subdivided, of the pool
//   fits             (ring points, 0, 0, 0), then three elements a ring point: its weights in c_00..c_22; one a class
//   coordinates      one element a coordinate of samples: (t, eta(t), eta'(t), 0); t = i / rate, i = 0..rate, then half a step
//                    inside either end
//   directions       one element h: (e^(2 pi i h / k), e^(2 pi i (h + 1) / k)); one run a k
//   chart samples    one element a pair of coordinates, x fastest: (zeta, d zeta / dz) of sector 0; where x = 0 and y > 0 zeta is
//                    told from the next direction, so that both faces at a spoke multiply the same numbers; one run a k
//   crease samples   two elements likewise: the parameter of the crease, its slopes by x and by y; one run a k
//   smooth UVs       of a patch one element a corner, as in its record, but with the element of a chart of texture coordinates:
//                    five elements a chart, two coefficients an element
//   patches          one element a corner: (pool index of c_00 | flags, direction, chart samples, crease samples), or, at levels,
//                    (.., .., 4 / k, 0). A regular face has kQuarter.. in place of crease samples
#ifndef SUPPLE_SHARED_BLEND_H
#define SUPPLE_SHARED_BLEND_H

#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

SUPPLE_SHARED_CONST kChartCoefficients = 9u;
SUPPLE_SHARED_CONST kCreasedChart = 0x80000000u; // its T is the parameter of the crease
SUPPLE_SHARED_CONST kStillCorner = 0x40000000u;  // the surface has no derivative at the corner
SUPPLE_SHARED_CONST kStillEdge = 0x20000000u;    // nor across the edge to the next corner
SUPPLE_SHARED_CONST kChordCorner = 0x10000000u;  // smooth texture coordinates: the surface's chart at the corner is creased
SUPPLE_SHARED_CONST kPoolIndexMask = 0x0FFFFFFFu;

// How a corner of a regular face tells its coefficients, along a row of samples and across it, from those of its chart.
SUPPLE_SHARED_CONST kQuarterSwapped = 1u;
SUPPLE_SHARED_CONST kQuarterBackAlong = 2u; // odd powers along the row change their sign
SUPPLE_SHARED_CONST kQuarterBackAcross = 4u;

// With level of detail a normal is taken 1 / kStillSteps of the patch inside where it lies still: half the shortest
// segment that there is, whatever the level, so that a place has one normal.
SUPPLE_SHARED_CONST kStillSteps = 126u;

SUPPLE_SHARED_END

#endif
