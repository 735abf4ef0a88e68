// Pattern tables: which points of a fragment each refined point is made of. They depend on the subdivision, the number
// of sectors and whether the fan is open, never on the cage or the depth. Order and rules: docs/kernel.md.
#pragma once

#include "surface/kernel/mesh.h"

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

namespace supple::surface::kernel {

/// The spiral index. Point (s, a, b) of a vertex fragment lies a steps along spoke s and b steps along spoke s + 1,
/// ring r = max(a, b) (Catmull-Clark) or a + b (Loop); ring r follows ring r - 1, the centre is 0. The same index on
/// every level, so that one table serves all depths.
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
/// Points of radius `radius`, the centre included.
[[nodiscard]] uint32_t pointCount(const Fan& fan, uint32_t radius);
/// a and b may be negative, which leads into the neighbouring sectors; kNoPoint outside an open fan.
[[nodiscard]] uint32_t pointIndex(const Fan& fan, uint32_t sector, int32_t a, int32_t b);
/// Facets of Loop: (a, b) from corner c0, side n; with a halo of one. kNoPoint for the two corners the halo lacks.
[[nodiscard]] uint32_t facetPointCount(uint32_t side);
[[nodiscard]] uint32_t facetPointIndex(uint32_t side, int32_t a, int32_t b);

/// How a point of the next level is computed.
enum class Rule : uint8_t { vertex = 0, edge = 1, face = 2, centre = 3 };
inline constexpr uint32_t kNoSpoke = 0xFFFFFFFFu;

/// Sources, in the order of the rule's sum:
///   vertex  Catmull-Clark: c; its neighbours are those of `neighbours[c]`. Loop: c, axis+, axis-, L1, L2, R1, R2.
///   edge    the ends A, B; Catmull-Clark L_A, L_B, R_A, R_B; Loop L, R
///   face    the corners as two opposite pairs
struct Row {
    Rule rule = Rule::vertex;
    uint32_t spoke = kNoSpoke; ///< whose sharpness acts on it; for facets the side 0..2
    std::array<uint32_t, 7> sources{};
};

/// Neighbours of a covered point counter-clockwise from its axis on: 8 for Catmull-Clark (edge, face, ...), 6 for Loop.
using Neighbours = std::array<uint32_t, 8>;

struct Pattern {
    std::vector<Row> rows; ///< of every point of the refined level; row i makes point i
    /// Fans: of every covered point (without the halo); entry 0 (centre) is unused. Facets, whose halo stands between
    /// the covered points: of every point, those of the halo their own neighbours. Outside an open fan the point itself
    /// stands in; nothing reads it, as the boundary is sharp.
    std::vector<Neighbours> neighbours;
    /// Like `neighbours`: the spoke a point lies on, or kNoSpoke; of facets the line of a corner (kNoSpoke elsewhere).
    std::vector<uint32_t> spokes;
};

/// Serves a fan's levels 1..steps: level j, of radius 2^j + 1, is made of level j - 1 by the first pointCount(2^j + 1)
/// rows; the neighbours cover radius 2^steps.
[[nodiscard]] Pattern fanPattern(const Fan& fan, uint32_t steps);
/// A facet's level `step` (side 2^step) from the one before, and neighbours on that level. step 0 has neighbours alone.
[[nodiscard]] Pattern facetPattern(uint32_t step);

} // namespace supple::surface::kernel
