// The weights of P_m, per kind of sector, in double. They depend on connectivity only.
#pragma once

#include "surface/pm/mesh.h"

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

namespace supple::surface::pm {

/// The factors of a sector's sums in (13) and (15). In a closed sector v = p + limit * sum (f_j - p) and tau = tangent
/// * sum of cosines or sines times e_j. In an open sector the sum has e_j - v instead of e_j, for the edges inside.
struct SectorScales {
    double limit = 0.0;
    double tangent = 0.0;
};
[[nodiscard]] SectorScales sectorScales(SectorKind kind, uint32_t facets);

/// The weights of a sector without creased edges. v, tau1 and tau2 are sums over the far ends X_j of the edges and the
/// Q_j of the facets, all relative to the vertex. The vectors have one entry per edge or per facet.
struct SectorWeights {
    std::vector<double> limitEdge, limitFace;
    std::vector<double> tau1Edge, tau1Face;
    std::vector<double> tau2Edge, tau2Face;
};
[[nodiscard]] SectorWeights makeSectorWeights(SectorKind kind, uint32_t facets);

/// The class of an edge v0 -> v1 of a P_m facet, for (20).
struct EdgeClass {
    uint32_t sides = 4;
    std::array<uint32_t, 2> valences{}; ///< Sector::valence() at v0 and v1
    bool cut = false;                   ///< a boundary or a hard edge
    std::array<bool, 2> ends{};         ///< it is the first or the last edge of the sector at v0, at v1

    bool operator<(const EdgeClass& other) const {
        return std::tie(sides, valences, cut, ends) < std::tie(other.sides, other.valences, other.cut, other.ends);
    }
};
/// The factors of T1 - t0 (`along`), of t - v at the end itself (`own`), and of f - f_across (`across`; f - t if the
/// sector ends at the edge). Entry 0 is for b211 at v0, entry 1 for b121 at v1.
struct EdgeFactors {
    std::array<double, 2> along{}, own{}, across{};
};
[[nodiscard]] EdgeFactors makeEdgeFactors(const EdgeClass& edge);

} // namespace supple::surface::pm
