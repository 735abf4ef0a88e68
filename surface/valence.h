// What the weights of all schemes are made of: angles and the subdominant eigenvalue of a valence, in double.
#pragma once

#include <cstdint>
#include <utility>

namespace supple::surface {

/// cos and sin of 2 pi k / n. They are exact at quarter turns, so that regular vertices get 0, 1 and -1.
[[nodiscard]] std::pair<double, double> turn(uint32_t k, uint32_t n);

/// cos and sin of pi k / n. They are exact if they are 0, 1/2 or 1: regular vertices must get the regular weights.
[[nodiscard]] double cosineOfHalfTurns(uint32_t k, uint32_t n);
[[nodiscard]] double sineOfHalfTurns(uint32_t k, uint32_t n);

/// The subdominant eigenvalue of Catmull-Clark subdivision at an interior vertex; exactly 1/2 for valence 4. It is
/// lambda_N in P_m's formulas and rho_n in p-rep's.
[[nodiscard]] double subdominant(uint32_t valence);

} // namespace supple::surface
