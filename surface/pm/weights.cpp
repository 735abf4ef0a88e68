#include "surface/pm/weights.h"

#include "surface/valence.h"

namespace supple::surface::pm {

FanScales fanScales(FanKind kind, uint32_t facets) {
    const double q = facets;
    if (kind == FanKind::interior) {
        return {9.0 / (q * (q + 5.0)), 1.0 / (q * subdominant(facets))};
    }
    return {0.0, kind == FanKind::corner ? 0.0 : 1.0 / (q * subdominant(2 * facets))};
}

CornerTurn cornerTurn(uint32_t j, uint32_t facets, uint32_t width) {
    const auto [cosine, sine] = turn(j * width, 12 * facets);
    const auto [wholeCosine, wholeSine] = turn(width, 12); // 0 and 1 of a right angle
    return {cosine - wholeCosine / wholeSine * sine, sine / wholeSine};
}

std::pair<double, double> tangentTurn(const Fan& fan, uint32_t j) {
    if (fan.kind == FanKind::corner) {
        const CornerTurn at = cornerTurn(j, fan.facets, fan.width);
        return {at.first, at.last};
    }
    const FacetAngle angle = fan.angle();
    return turn(j * angle.part, angle.whole);
}

FanWeights makeFanWeights(const Fan& fan) {
    const FanKind kind = fan.kind;
    const uint32_t facets = fan.facets;
    const bool closed = fan.closed();
    const uint32_t edges = fan.edges();
    const FanScales scales = fanScales(kind, facets);
    FanWeights w;
    w.limitEdge = w.e1Edge = w.e2Edge = std::vector<double>(edges, 0.0);
    w.limitFace = w.e1Face = w.e2Face = std::vector<double>(facets, 0.0);
    for (uint32_t j = 0; j < edges; ++j) {
        const auto [cosine, sine] = tangentTurn(fan, j);
        w.cosines.push_back(cosine);
        w.sines.push_back(sine);
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
            addFace(j, scales.limit, w.limitEdge, w.limitFace);
            addEdge(j, scales.tangent * w.cosines[j], w.e1Edge, w.e1Face);
            addEdge(j, scales.tangent * w.sines[j], w.e2Edge, w.e2Face);
        }
        return w;
    }
    if (kind == FanKind::corner) {
        w.e1Edge[0] = w.e2Edge[facets] = 1.0 / 3.0;
        return w;
    }
    w.limitEdge[0] = w.limitEdge[facets] = 1.0 / 6.0;
    w.e1Edge[0] = 1.0 / 6.0;
    w.e1Edge[facets] = -1.0 / 6.0;
    for (uint32_t j = 1; j < facets; ++j) {
        const double factor = scales.tangent * w.sines[j];
        addEdge(j, factor, w.e2Edge, w.e2Face);
        w.e2Edge[0] -= factor / 6.0;
        w.e2Edge[facets] -= factor / 6.0;
    }
    return w;
}

EdgeFactors makeEdgeFactors(const EdgeClass& edge) {
    const double mu = 1.0 - turn(1, edge.sides).first;
    std::array<double, 2> chi{};
    double sines = 0.0;
    for (size_t k = 0; k < 2; ++k) {
        const auto [cosine, sine] = turn(edge.angles[k].part, edge.angles[k].whole);
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
