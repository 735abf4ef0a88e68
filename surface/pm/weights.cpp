#include "surface/pm/weights.h"

#include "surface/valence.h"

namespace supple::surface::pm {

SectorScales sectorScales(SectorKind kind, uint32_t facets) {
    const double q = facets;
    if (kind == SectorKind::interior) {
        return {9.0 / (q * (q + 5.0)), 1.0 / (q * subdominant(facets))};
    }
    return {0.0, kind == SectorKind::crease ? 1.0 / (q * subdominant(2 * facets)) : 0.0};
}

SectorWeights makeSectorWeights(SectorKind kind, uint32_t facets) {
    const bool closed = kind == SectorKind::interior;
    const uint32_t edges = closed ? facets : facets + 1;
    Sector sector;
    sector.facets = facets;
    sector.kind = kind;
    const uint32_t valence = sector.valence();
    const SectorScales scales = sectorScales(kind, facets);
    SectorWeights w;
    for (std::vector<double>* v : {&w.limitEdge, &w.tau1Edge, &w.tau2Edge}) {
        v->assign(edges, 0.0);
    }
    for (std::vector<double>* v : {&w.limitFace, &w.tau1Face, &w.tau2Face}) {
        v->assign(facets, 0.0);
    }
    // factor * (f_j - p), f_j - p = (2 (X_j + X_j+1) + Q_j) / 9
    const auto addFace = [&](uint32_t j, double factor, std::vector<double>& edge, std::vector<double>& face) {
        edge[j] += factor * 2.0 / 9.0;
        edge[(j + 1) % edges] += factor * 2.0 / 9.0;
        face[j] += factor / 9.0;
    };
    // factor * (e_j - p), e_j = (f_j + f_j-1) / 2
    const auto addEdge = [&](uint32_t j, double factor, std::vector<double>& edge, std::vector<double>& face) {
        addFace(j, factor / 2.0, edge, face);
        addFace((j + facets - 1) % facets, factor / 2.0, edge, face);
    };
    if (closed) {
        for (uint32_t j = 0; j < facets; ++j) {
            const auto [cosine, sine] = turn(j, valence);
            addFace(j, scales.limit, w.limitEdge, w.limitFace);
            addEdge(j, scales.tangent * cosine, w.tau1Edge, w.tau1Face);
            addEdge(j, scales.tangent * sine, w.tau2Edge, w.tau2Face);
        }
        return w;
    }
    if (kind == SectorKind::corner) {
        w.tau1Edge[0] = w.tau2Edge[facets] = 1.0 / 3.0;
        return w;
    }
    w.limitEdge[0] = w.limitEdge[facets] = 1.0 / 6.0;
    w.tau1Edge[0] = 1.0 / 6.0;
    w.tau1Edge[facets] = -1.0 / 6.0;
    for (uint32_t j = 1; j < facets; ++j) {
        const double factor = scales.tangent * turn(j, valence).second;
        addEdge(j, factor, w.tau2Edge, w.tau2Face);
        w.tau2Edge[0] -= factor / 6.0;
        w.tau2Edge[facets] -= factor / 6.0;
    }
    return w;
}

EdgeFactors makeEdgeFactors(const EdgeClass& edge) {
    const double mu = 1.0 - turn(1, edge.sides).first;
    std::array<double, 2> chi{};
    double sines = 0.0;
    for (size_t k = 0; k < 2; ++k) {
        const auto [cosine, sine] = turn(1, edge.valences[k]);
        chi[k] = 1.0 + cosine;
        sines += sine;
    }
    if (edge.cut) {
        sines = 2.0;
    }
    EdgeFactors factors;
    for (size_t k = 0; k < 2; ++k) {
        factors.along[k] = chi[k] / (4.0 * mu);
        factors.own[k] = (2.0 * mu - chi[1 - k]) / (8.0 * mu);
        factors.across[k] = (edge.ends[k] ? 2.0 : 1.0) * 3.0 / (8.0 * mu * sines);
    }
    return factors;
}

} // namespace supple::surface::pm
