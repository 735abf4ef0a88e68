// Lines of samples of a patch at levels, about as long as a side of its grid: what a lane of the wide mapping takes,
// where the patch's class has lines (kRunHasLines). GLSL and C++ share the very code, so that a test can count samples.
#ifndef SUPPLE_LOD_LINES_H
#define SUPPLE_LOD_LINES_H

#include "shaders/shared/lod.h"

SUPPLE_SHARED_BEGIN

SUPPLE_SHARED_FUNCTION uint formSides(uint form) {
    return form == kLodTriangleForm ? 3u : form == kLodPentagonForm ? 5u : 4u;
}
// A grid of rows has its sides, and the lines inside that run across it. A grid of rings has so many lines in each
// sector.
SUPPLE_SHARED_FUNCTION uint ringLines(uint capacity) {
    return capacity < 7u ? 1u : (capacity + 1u) / 4u;
}
SUPPLE_SHARED_FUNCTION uint linesOf(uint form, uint capacity) {
    return form == kLodQuadForm ? capacity + 3u : formSides(form) * ringLines(capacity);
}
// Of a patch: a pentagon's at the largest capacity. Workgroups have no fewer lanes.
SUPPLE_SHARED_CONST kMostLines = 80u;

// Samples of a grid of rows that follow each other: the number of the first one, and the step to the next.
struct SampleRow {
    uint first, step;
};
// Of a side, from its first corner up to the next: as many as the capacity.
SUPPLE_SHARED_FUNCTION SampleRow sideRowOf(uint side, uint capacity) {
    uint width = capacity + 1u, step = (side & 1u) == 0u ? 1u : width;
    uint first = side == 0u ? 0u : side == 1u ? capacity : side == 2u ? width * width - 1u : capacity * width;
    SampleRow row;
    row.first = first;
    row.step = side < 2u ? step : 0u - step;
    return row;
}
// Of row or column n inside, n = 1 .. capacity - 1, without its two ends on sides.
SUPPLE_SHARED_FUNCTION SampleRow innerRowOf(uint n, uint capacity, bool isColumn) {
    uint width = capacity + 1u;
    SampleRow row;
    row.first = isColumn ? n + width : n * width + 1u;
    row.step = isColumn ? width : 1u;
    return row;
}

// Samples of a grid of rings (surface/lod/grid.h) before a ring of a patch of m sides, and before a side of the ring.
SUPPLE_SHARED_FUNCTION uint ringStart(uint m, uint ring, uint capacity) {
    return m * ring * (capacity + 1u - ring);
}
SUPPLE_SHARED_FUNCTION uint ringSideStart(uint m, uint ring, uint side, uint capacity) {
    return ringStart(m, ring, capacity) + side * (capacity - 2u * ring);
}
// Line n of a sector has the samples n, n + ringLines(), .. of the sector's side, and behind it those of two rings, a
// long and a short one, so that all lines have about as many. A step of it: the ring, the sample's place k along the
// ring's side, and the last ring.
struct RingStep {
    uint ring, k, last;
};
// If its ring is behind the last, there is none.
SUPPLE_SHARED_FUNCTION RingStep firstRingStep(uint n, uint capacity) {
    RingStep at;
    at.ring = n + 1u;
    at.k = at.ring;
    at.last = (capacity - 1u) / 2u - n;
    return at;
}
// `end`: of the k along the ring's side.
SUPPLE_SHARED_FUNCTION RingStep nextRingStep(RingStep at, uint end) {
    ++at.k;
    if (at.k >= end) {
        at.ring = at.last > at.ring ? at.last : at.ring + 1u;
        at.k = at.ring;
    }
    return at;
}

SUPPLE_SHARED_END

#endif
