// The weights of P_m, per kind of fan, in double. They depend on connectivity only.
#pragma once

#include "surface/fans.h"
#include "surface/pm/mesh.h"

#include <array>
#include <cstdint>
#include <tuple>
#include <utility>

namespace supple::surface::pm {

/// The factors of a fan's sums in (13) and (15). In a closed fan v = p + limit * sum (f_j - p) and tau = tangent
/// * sum of cosines or sines times e_j. In an open fan the sum has e_j - v instead of e_j, for the edges inside.
struct FanScales {
    double limit = 0.0;
    double tangent = 0.0;
};
[[nodiscard]] FanScales fanScales(FanKind kind, uint32_t facets);

/// The tangent of edge j of a corner of `facets` facets is first * t_0 + last * t_q, as offsets from the vertex.
struct CornerTurn {
    double first = 0.0;
    double last = 0.0;
};
[[nodiscard]] CornerTurn cornerTurn(uint32_t j, uint32_t facets, uint32_t width);

/// The factors of tau1 and tau2 in the tangent of edge j. Those of corners are t_0 and t_q.
[[nodiscard]] std::pair<double, double> tangentTurn(const Fan& fan, uint32_t j);

/// The weights of a fan that has no creased edges and is not joined: v is the limit point, tau1 and tau2 are e1 and e2.
/// They depend on its kind, facets and width.
[[nodiscard]] FanWeights makeFanWeights(const Fan& fan);

/// The class of an edge v0 -> v1 of a P_m facet, for (20).
struct EdgeClass {
    uint32_t sides = 4;
    std::array<FacetAngle, 2> angles{}; ///< Fan::angle() at v0 and v1
    bool cut = false;                   ///< a boundary or a hard edge
    std::array<bool, 2> ends{};         ///< it is the first or the last edge of the fan at v0, at v1

    bool operator<(const EdgeClass& other) const {
        return std::tie(sides, angles, cut, ends) < std::tie(other.sides, other.angles, other.cut, other.ends);
    }
};
/// The factors of T1 - t0 (`along`), of t - v at the end itself (`own`), and of f - f_across (`across`; f - t if the
/// fan ends at the edge). Entry 0 is for b211 at v0, entry 1 for b121 at v1.
struct EdgeFactors {
    std::array<double, 2> along{}, own{}, across{};
};
[[nodiscard]] EdgeFactors makeEdgeFactors(const EdgeClass& edge);

} // namespace supple::surface::pm
