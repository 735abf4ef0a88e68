// The pattern of a level of detail: where the samples of an edge, a row or a column lie for a real-valued level.
//
// A level L in [1, 63] is a number of segments: an odd integer has L equal ones; in between, one pair of segments grows
// from nothing. Samples are counted by a capacity R >= L, odd: segments that L does not have are of zero width.
// Distinct parameters depend on L alone, not on R. After Moreton, "Watertight tessellation using forward differencing"
// (2001) and the fractional odd spacing of D3D11 and Vulkan, with a fixed order of birth so that patterns are nested.
#pragma once

#include "shaders/shared/lod.h"

#include <array>
#include <cstdint>
#include <vector>

namespace supple::surface::lod {

inline constexpr float kMaxLevel = 63.0f;

/// Capacities that grids come in, rising.
inline constexpr std::array<uint32_t, shared::kCapacityCount> kCapacities{SUPPLE_LOD_CAPACITIES};

/// Index of the smallest capacity that is not below `level` (1..63).
[[nodiscard]] uint32_t capacityIndexFor(float level);

/// A level as the device stores it: a = (L - 1) / 2 and 1 / L.
struct LevelPair {
    float a = 0.0f;
    float inverse = 1.0f;
};
[[nodiscard]] LevelPair levelPair(float level);

/// A parameter and its complement; sample capacity - i has them swapped, bit for bit.
struct Parameter {
    float t = 0.0f;
    float s = 1.0f;
};
/// Sample i of 0..capacity, in the device's float32 operations.
[[nodiscard]] Parameter parameter(uint32_t capacity, uint32_t i, LevelPair level);

/// Words of all capacities, one run after the other: for h = (capacity - 1) / 2 the words n = 0..h, whose bit j is set
/// where the j-th segment from the corner is among the n born first.
[[nodiscard]] std::vector<uint32_t> patternWords();
/// Where the words of each capacity begin.
inline constexpr std::array<uint32_t, shared::kCapacityCount> kFirstPatternWords{SUPPLE_LOD_FIRST_WORDS};

} // namespace supple::surface::lod
