// P_m weights per kind of sector, computed once in double. They depend on connectivity only.
#pragma once

#include "surface/pm/mesh.h"

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

namespace supple::surface::pm {

/// The factors of a sector's sums in (13) and (15): v = p + limit * sum (f_j - p) in closed sectors, tau = tangent *
/// sum of cosines or sines times e_j (in open sectors times e_j - v, over the edges inside).
struct SectorScales {
    double limit = 0.0;
    double tangent = 0.0;
};
[[nodiscard]] SectorScales sectorScales(SectorKind kind, uint32_t facets);

/// A sector without creased edges, multiplied out: v, tau1, tau2 as sums over the edges' far ends X_j and the facets'
/// Q_j, all relative to the vertex. `edge` has one entry an edge, `face` one a facet.
struct SectorWeights {
    std::vector<double> limitEdge, limitFace;
    std::vector<double> tau1Edge, tau1Face;
    std::vector<double> tau2Edge, tau2Face;
};
[[nodiscard]] SectorWeights makeSectorWeights(SectorKind kind, uint32_t facets);

/// An edge of a P_m facet, v0 -> v1, in (20). Valences are those of the sectors at its ends; `cut` where the edge is a
/// boundary or hard; `ends[k]` where it is the first or last of the sector at v_k.
struct EdgeClass {
    uint32_t sides = 4;
    std::array<uint32_t, 2> valences{};
    bool cut = false;
    std::array<bool, 2> ends{};

    bool operator<(const EdgeClass& other) const {
        return std::tie(sides, valences, cut, ends) < std::tie(other.sides, other.valences, other.cut, other.ends);
    }
};
/// Factors of T1 - t0, of the end's own t - v, and of f - f_across (f - t where the edge ends the sector), for b211 (at
/// v0) and b121 (at v1).
struct EdgeFactors {
    std::array<double, 2> along{}, own{}, across{};
};
[[nodiscard]] EdgeFactors makeEdgeFactors(const EdgeClass& edge);

} // namespace supple::surface::pm
