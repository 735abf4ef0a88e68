#include "cage/features.h"

#include <algorithm>

namespace supple::cage {
namespace {

/// NaN compares false and so counts as 0.
float atLeastZero(float sharpness) {
    return sharpness > 0.0f ? sharpness : 0.0f;
}

std::string noSuchEdge(const std::string& what) {
    return what + ": the cage has no such edge";
}

/// The spoke slot at `vertex` of one of its edges.
uint32_t spokeAt(const Cage& cage, const Topology& topology, uint32_t edge, uint32_t vertex) {
    const auto [corner, twin] = topology.edges[edge];
    if (cage.faceVertices[corner] == vertex) {
        return topology.cornerSpokes[corner];
    }
    if (twin != kNone) {
        return topology.cornerSpokes[twin];
    }
    return topology.cornerSpokesBack[nextCorner(cage, topology.cornerFaces[corner], corner)];
}

} // namespace

Features buildFeatures(const Cage& cage, const Topology& topology) {
    Features features;
    features.edgeSharpness.assign(topology.edges.size(), 0.0f);
    features.vertexSharpness.assign(cage.vertexCount(), 0.0f);
    features.spokeAlphas.assign(topology.spokeVertices.size(), -1.0f);
    for (size_t e = 0; e < topology.edges.size(); ++e) {
        if (topology.edges[e].twin == kNone) {
            features.edgeSharpness[e] = kHardSharpness;
        }
    }
    for (const Crease& crease : cage.creases) {
        const uint32_t edge = findEdge(cage, topology, crease.a, crease.b);
        if (edge == kNone) {
            features.unused.push_back(
                noSuchEdge("crease (" + std::to_string(crease.a) + ", " + std::to_string(crease.b) + ")"));
            continue;
        }
        float& sharpness = features.edgeSharpness[edge];
        sharpness = std::max(sharpness, atLeastZero(crease.sharpness));
    }
    for (const SharpVertex& sharp : cage.sharpVertices) {
        if (sharp.vertex >= cage.vertexCount()) {
            features.unused.push_back("sharp vertex " + std::to_string(sharp.vertex) + ": the cage has only " +
                                      std::to_string(cage.vertexCount()) + " vertices");
            continue;
        }
        float& sharpness = features.vertexSharpness[sharp.vertex];
        sharpness = std::max(sharpness, atLeastZero(sharp.sharpness));
    }
    for (const CreaseScalar& scalar : cage.creaseScalars) {
        const std::string name =
            "crease scalar " + std::to_string(scalar.vertex) + " -> " + std::to_string(scalar.toward);
        const uint32_t edge = findEdge(cage, topology, scalar.vertex, scalar.toward);
        if (edge == kNone) {
            features.unused.push_back(noSuchEdge(name));
            continue;
        }
        if (!(scalar.alpha >= 0.0f && scalar.alpha <= 1.0f)) {
            features.unused.push_back(name + ": " + std::to_string(scalar.alpha) + " is not between 0 and 1");
            continue;
        }
        features.spokeAlphas[spokeAt(cage, topology, edge, scalar.vertex)] = scalar.alpha;
    }
    return features;
}

} // namespace supple::cage
