// Nets in the tables (shaders/shared/exact.h). Private to exact/.
#pragma once

#include "surface/exact/needed_rows.h"
#include "surface/table_writer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace supple::surface::exact {

/// The points that are there more than once, by pool index: the first one.
[[nodiscard]] inline std::map<uint32_t, uint32_t> copiesOf(const NeededRows& points, uint32_t firstIndex) {
    std::map<uint32_t, uint32_t> copies;
    for (const auto& [copy, first] : points.firsts()) {
        copies.emplace(firstIndex + copy, firstIndex + first);
    }
    return copies;
}

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

} // namespace supple::surface::exact
