// Patterns: which points of a fragment each refined point is made of. They depend on the subdivision, the number of
// sectors and whether the fan is open, and not on the cage or the depth. Order and rules: docs/subdivision.md.
#pragma once

#include "surface/subdivision/mesh.h"

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

namespace supple::surface::subdivision {

/// The shape of a vertex fragment, which decides the spiral index of its points. Point (s, a, b) lies a steps along
/// spoke s and b steps along spoke s + 1. Its ring is r = max(a, b) for Catmull-Clark and a + b for Loop. The centre
/// has index 0, and ring r follows ring r - 1. The index is the same at every level, so that one table serves all
/// depths.
struct Fan {
    Subdivision subdivision = Subdivision::catmullClark;
    uint32_t sectors = 4;
    bool open = false;

    bool operator==(const Fan&) const = default;
    bool operator<(const Fan& other) const {
        return std::tie(subdivision, sectors, open) < std::tie(other.subdivision, other.sectors, other.open);
    }
};
inline constexpr uint32_t kNoPoint = 0xFFFFFFFFu;
/// The number of points up to this radius, including the centre.
[[nodiscard]] uint32_t pointCount(const Fan& fan, uint32_t radius);
/// a and b may be negative: then the point lies in the neighbouring sector. kNoPoint outside an open fan.
[[nodiscard]] uint32_t pointIndex(const Fan& fan, uint32_t sector, int32_t a, int32_t b);
/// The same for the facets of Loop. (a, b) counts from corner c0, a side has `side` steps, and there is a halo of one
/// step. kNoPoint for the two corners that the halo lacks.
[[nodiscard]] uint32_t facetPointCount(uint32_t side);
[[nodiscard]] uint32_t facetPointIndex(uint32_t side, int32_t a, int32_t b);

/// How a point of the next level is computed.
enum class Rule : uint8_t { vertex = 0, edge = 1, face = 2, centre = 3 };
inline constexpr uint32_t kNoSpoke = 0xFFFFFFFFu;

/// How one point is made. Its sources, in the order of the rule's sum:
///   vertex  Catmull-Clark: c, whose neighbours are `neighbours[c]`. Loop: c, axis+, axis-, L1, L2, R1, R2.
///   edge    the ends A, B; then Catmull-Clark: L_A, L_B, R_A, R_B. Loop: L, R.
///   face    the corners, as two pairs of opposite ones
struct Row {
    Rule rule = Rule::vertex;
    uint32_t spoke = kNoSpoke; ///< the spoke whose sharpness acts on it; in a facet the side 0..2
    std::array<uint32_t, 7> sources{};
};

/// The neighbours of a point, counter-clockwise from its axis on: 8 for Catmull-Clark (edge, face, ...), 6 for Loop.
using Neighbours = std::array<uint32_t, 8>;

struct Pattern {
    std::vector<Row> rows; ///< row i makes point i of the refined level
    /// In a fan: the neighbours of every point inside the halo; entry 0, the centre, is unused. In a facet, where
    /// points of the halo lie between the others: the neighbours of every point. A neighbour that would lie outside an
    /// open fan is the point itself. Nothing reads it, because the boundary is sharp.
    std::vector<Neighbours> neighbours;
    /// For the same points: the spoke that the point lies on, or in a facet the line through a corner; or kNoSpoke.
    std::vector<uint32_t> spokes;
};

/// The pattern of a fan's levels 1..steps. Level j has radius 2^j + 1; the first pointCount(2^j + 1) rows make it of
/// level j - 1. The neighbours cover radius 2^steps.
[[nodiscard]] Pattern fanPattern(const Fan& fan, uint32_t steps);
/// The pattern that makes level `step` of a facet (side 2^step) of the level before, and the neighbours at that level.
/// At step 0 there are only neighbours.
[[nodiscard]] Pattern facetPattern(uint32_t step);

} // namespace supple::surface::subdivision
