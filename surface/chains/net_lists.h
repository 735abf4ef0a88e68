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

static_assert(shared::kNetPoints <= shared::kNetListSharp && shared::kNetListSharp < shared::kNetListNormals);
static_assert(shared::kTriangleNetPoints <= shared::kTriangleNetListNormals);
// Four normals, then the last word.
static_assert(shared::kNetListNormals + 4 == 2 * shared::kNetListLastWord);
static_assert(shared::kTriangleNetListNormals + 4 == 2 * shared::kTriangleNetListLastWord);
static_assert(shared::kNetListLastWord == 4 * shared::kNetListElements - 1);
static_assert(shared::kTriangleNetListLastWord == 4 * shared::kTriangleNetListElements - 1);

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

/// What stands in a net list behind its points: four numbers, the first of them `at`, and the last word.
struct NetListEnd {
    uint32_t at = 0;
    std::array<uint32_t, 4> numbers{};
    uint32_t last = 0;
    bool sharp = false; ///< of a quad: the sharpness of its sides follows
};
/// Writes the points of a net as a net list of so many elements.
inline void writeNetList(std::span<const uint32_t> points, uint32_t first, uint32_t elements, const NetListEnd& end,
                         TableWriter& writer) {
    std::vector<uint32_t> netList(size_t{8} * elements, 0);
    std::copy(end.numbers.begin(), end.numbers.end(), netList.begin() + end.at);
    std::transform(points.begin(), points.end(), netList.begin(), [&](uint32_t point) { return point - first; });
    if (end.sharp) {
        netList[shared::kNetListSharp] = 1;
    }
    netList[netList.size() - 2] = end.last & 0xFFFFu;
    netList.back() = end.last >> 16;
    writer.putHalves(netList);
}

} // namespace supple::surface::chains
