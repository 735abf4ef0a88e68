#include "cage/features.h"

#include "cage/message.h"

#include <algorithm>

namespace supple::cage {
namespace {

/// NaN compares false and so counts as 0.
float atLeastZero(float sharpness) {
    return sharpness > 0.0f ? sharpness : 0.0f;
}

/// What is not used, one line for each kind.
struct Unused {
    Found creases;
    Found vertices;
    Found scalars;
    Found alphas;

    [[nodiscard]] std::vector<std::string> told() const {
        std::vector<std::string> lines;
        const auto tell = [&](const Found& found) {
            if (found.count > 0) {
                lines.push_back(found.first +
                                (found.count > 1 ? ", and " + std::to_string(found.count - 1) + " more like it" : ""));
            }
        };
        tell(creases);
        tell(vertices);
        tell(scalars);
        tell(alphas);
        return lines;
    }
};

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
    Unused unused;
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
            unused.creases.add([&] {
                return noSuchEdge("crease (" + std::to_string(crease.a) + ", " + std::to_string(crease.b) + ")");
            });
            continue;
        }
        float& sharpness = features.edgeSharpness[edge];
        sharpness = std::max(sharpness, atLeastZero(crease.sharpness));
        if (crease.set != kNone) {
            features.edgeSets.resize(topology.edges.size(), kNone);
            features.edgeSets[edge] = crease.set;
        }
    }
    for (const SharpVertex& sharp : cage.sharpVertices) {
        if (sharp.vertex >= cage.vertexCount()) {
            unused.vertices.add([&] {
                return "sharp vertex " + std::to_string(sharp.vertex) + ": the cage has only " +
                       std::to_string(cage.vertexCount()) + " vertices";
            });
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
            unused.scalars.add([&] { return noSuchEdge(name); });
            continue;
        }
        if (!(scalar.alpha >= 0.0f && scalar.alpha <= 1.0f)) {
            unused.alphas.add([&] { return name + ": " + std::to_string(scalar.alpha) + " is not between 0 and 1"; });
            continue;
        }
        features.spokeAlphas[spokeAt(cage, topology, edge, scalar.vertex)] = scalar.alpha;
    }
    features.unused = unused.told();
    return features;
}

std::vector<std::string> notesOnAlphas(const Cage& cage) {
    std::vector<std::string> notes;
    if (!cage.creaseScalars.empty()) {
        notes.push_back(std::to_string(cage.creaseScalars.size()) +
                        " crease scalars: not used, they are for P_m alone");
    }
    if (!cage.creaseSets.empty()) {
        notes.push_back(counted(cage.creaseSets.size(), "crease set", "crease sets") +
                        ": as sharp as the file says, for instances change them under P_m alone");
    }
    return notes;
}

std::string sharpRoundCorners(const Cage& cage) {
    const size_t count = cage.roundCorners.size();
    return count == 0
               ? ""
               : std::to_string(count) + (count == 1 ? " corner of the border is" : " corners of the border are") +
                     " to be round (interpolateBoundary edgeOnly); sharp here";
}

} // namespace supple::cage
