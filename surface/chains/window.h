// Nets in the tables (shaders/shared/chains.h). Private to chains/.
#pragma once

#include "shaders/shared/chains.h"
#include "surface/table_writer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace supple::surface::chains {

static_assert(shared::kNetPoints <= shared::kWindowNormals);
static_assert(shared::kTriangleNetPoints <= shared::kTriangleWindowNormals);
// Four normals, then the last word.
static_assert(shared::kWindowNormals + 4 == 2 * shared::kWindowLastWord);
static_assert(shared::kTriangleWindowNormals + 4 == 2 * shared::kTriangleWindowLastWord);
static_assert(shared::kWindowLastWord == 4 * shared::kWindowElements - 1);
static_assert(shared::kTriangleWindowLastWord == 4 * shared::kTriangleWindowElements - 1);

/// What the points of a net are counted from: the smallest.
[[nodiscard]] inline uint32_t firstOfNet(std::span<const uint32_t> points) {
    return *std::min_element(points.begin(), points.end());
}

/// Writes the points of a net, 16 bits each, counted from `first`.
inline void writeNet(std::span<const uint32_t> points, uint32_t first, TableWriter& writer) {
    std::vector<uint32_t> halves(points.size() + points.size() % 2, 0);
    std::transform(points.begin(), points.end(), halves.begin(), [&](uint32_t point) { return point - first; });
    writer.putHalves(halves);
}

/// What stands in a window behind its points: four numbers, the first of them `at`, and the last word.
struct WindowEnd {
    uint32_t at = 0;
    std::array<uint32_t, 4> numbers{};
    uint32_t last = 0;
};
/// Writes the points of a net as a window of so many elements.
inline void writeWindow(std::span<const uint32_t> points, uint32_t first, uint32_t elements, const WindowEnd& end,
                        TableWriter& writer) {
    std::vector<uint32_t> window(size_t{8} * elements, 0);
    std::copy(end.numbers.begin(), end.numbers.end(), window.begin() + end.at);
    std::transform(points.begin(), points.end(), window.begin(), [&](uint32_t point) { return point - first; });
    window[window.size() - 2] = end.last & 0xFFFFu;
    window.back() = end.last >> 16;
    writer.putHalves(window);
}

} // namespace supple::surface::chains
