// How much is built from a file.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace supple::cage {

/// Accessors may be shared and nodes may share a mesh, so a small file can ask for much. All parts together are
/// bounded.
inline constexpr uint64_t kMaxVertices = 1u << 24;
inline constexpr uint64_t kMaxCorners = 3u << 24;

/// The most that a character has: an instance has a number for each.
inline constexpr uint32_t kMaxCreaseSets = 64;

/// Coordinates beyond this are refused: a normal is a product of two lengths, and its length one of four, which must be
/// a float still.
inline constexpr float kMaxCoordinate = 1e9f;

/// Why a number cannot be a coordinate; null if it can.
[[nodiscard]] inline const char* faultOfCoordinate(float value) {
    if (!std::isfinite(value)) {
        return "not finite";
    }
    return std::abs(value) <= kMaxCoordinate ? nullptr : "beyond 1e+09";
}
/// The first of several.
[[nodiscard]] inline const char* faultOfCoordinates(const float* values, size_t count) {
    const char* fault = nullptr;
    for (size_t i = 0; i < count && fault == nullptr; ++i) {
        fault = faultOfCoordinate(values[i]);
    }
    return fault;
}

} // namespace supple::cage
