// The weights of P_m, per kind of fan, in double. They depend on connectivity only.
#pragma once

#include "surface/fans.h"
#include "surface/pm/mesh.h"

#include <array>
#include <cstdint>
#include <tuple>

namespace supple::surface::pm {

/// The factors of a fan's sums in (13) and (15). In a closed fan v = p + limit * sum (f_j - p) and tau = tangent
/// * sum of cosines or sines times e_j. In an open fan the sum has e_j - v instead of e_j, for the edges inside.
struct FanScales {
    double limit = 0.0;
    double tangent = 0.0;
};
[[nodiscard]] FanScales fanScales(FanKind kind, uint32_t facets);

/// The weights of a fan without creased edges: v is the limit point, tau1 and tau2 are e1 and e2.
[[nodiscard]] FanWeights makeFanWeights(FanKind kind, uint32_t facets);

/// The class of an edge v0 -> v1 of a P_m facet, for (20).
struct EdgeClass {
    uint32_t sides = 4;
    std::array<uint32_t, 2> valences{}; ///< Fan::valence() at v0 and v1
    bool cut = false;                   ///< a boundary or a hard edge
    std::array<bool, 2> ends{};         ///< it is the first or the last edge of the fan at v0, at v1

    bool operator<(const EdgeClass& other) const {
        return std::tie(sides, valences, cut, ends) < std::tie(other.sides, other.valences, other.cut, other.ends);
    }
};
/// The factors of T1 - t0 (`along`), of t - v at the end itself (`own`), and of f - f_across (`across`; f - t if the
/// fan ends at the edge). Entry 0 is for b211 at v0, entry 1 for b121 at v1.
struct EdgeFactors {
    std::array<double, 2> along{}, own{}, across{};
};
[[nodiscard]] EdgeFactors makeEdgeFactors(const EdgeClass& edge);

} // namespace supple::surface::pm
