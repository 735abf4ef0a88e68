// What the weights of all schemes are made of: turns, and the eigenvalue of a valence. In double, of integers alone.
#pragma once

#include <cstdint>
#include <utility>

namespace supple::surface {

/// cos and sin of 2 pi k / n, exact at quarter turns, so that regular vertices get 0, 1 and -1.
[[nodiscard]] std::pair<double, double> turn(uint32_t k, uint32_t n);

/// cos and sin of pi k / n, exact where they are 0, a half or 1: regular vertices must have the regular rule's weights.
[[nodiscard]] double cosineOfHalfTurns(uint32_t k, uint32_t n);
[[nodiscard]] double sineOfHalfTurns(uint32_t k, uint32_t n);

/// The subdominant eigenvalue of Catmull-Clark subdivision at an interior vertex; exactly 1/2 for valence 4. P_m's
/// lambda_N, p-rep's rho_n.
[[nodiscard]] double subdominant(uint32_t valence);

} // namespace supple::surface
