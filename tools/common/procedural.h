// Procedural control cages of any size, for benchmarks, samples and tests. Every quad stands counter-clockwise seen
// from outside; the order of vertices and faces depends on the arguments alone.
#pragma once

#include "cage/character.h"

#include <cstdint>

namespace supple::cage {

/// The cage alone; its per-corner attributes stay empty.
/// A unit sphere made of six square grids of n x n quads: 6 n^2 quads, 6 n^2 + 2 vertices, of which the eight cube
/// corners have valence 3 and all others 4. n = 15 gives 1350 quads. quadsPerSide in 1..9000; anything else gives an
/// empty cage.
[[nodiscard]] Cage makeCubeSphere(uint32_t quadsPerSide);

/// A torus on which no quad is regular: around x across lattice points of valence 6, joined by 2 around x across
/// triangles that are each split into three quads. 6 around x across quads, as many vertices: valence 6 at the lattice
/// points, 3 at the triangles' centres, 4 at the edges' midpoints; every quad has one corner of valence 6, one of 3 and
/// two of 4 and every edge one irregular end. (18, 12) gives 1296 quads. Both arguments in 3..9000; anything else gives
/// an empty cage. Ring radius 1, tube radius 0.45, the ring in the xz plane.
[[nodiscard]] Cage makeSplitTorus(uint32_t around, uint32_t across);

} // namespace supple::cage
