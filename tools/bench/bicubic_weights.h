// Weights of bicubic evaluation on a grid, the same for the plain loop and the AVX2 one.
#pragma once

#include <cstdint>

namespace supple::bench {

inline constexpr uint32_t kMaxSide = 65;

/// Bernstein polynomials b and their derivatives d of every sample of a row, one array a polynomial, so that a loop
/// over a row vectorizes.
struct BicubicWeights {
    float b[4][kMaxSide], d[4][kMaxSide];
};

void fillBicubicWeights(BicubicWeights& weights, uint32_t rate);

} // namespace supple::bench
