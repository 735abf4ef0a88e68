// The tessellation grid: shared triangle indices and parameter pairs.
#pragma once

#include <cstdint>
#include <vector>

namespace supple::surface {

inline constexpr uint32_t kMaxRate = 64; ///< segments along a patch edge

/// Two triangles a cell of a (rate + 1)^2 grid, samples row-major with u fastest, counter-clockwise where u x v points
/// at the viewer. Shared by all quad patches of a rate.
[[nodiscard]] std::vector<uint16_t> quadGridIndices(uint32_t rate);

/// Pairs (k / rate, (rate - k) / rate), k = 0..rate, for every rate 1..kMaxRate one after the other, correctly rounded.
[[nodiscard]] std::vector<float> parameterPairs();
/// Where the pairs of a rate begin, in pairs.
[[nodiscard]] constexpr uint32_t firstPair(uint32_t rate) {
    return rate * (rate + 1) / 2 - 1;
}

} // namespace supple::surface
