// A cage, damaged and repaired, with what was said about it.
#pragma once

#include "cage/repair.h"
#include "cage/topology.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

namespace supple::test {

using Strings = std::vector<std::string>;
using Indices = std::vector<uint32_t>;

struct Repaired {
    cage::Cage cage;
    cage::SkinWeights weights;
    cage::Morphs morphs;
    Strings found;   ///< "cage: 1 edge ..."
    Strings repairs; ///< what was done about each
    std::string refusal;
};

/// Repairs a cage, and checks that a topology can be built of what comes out. Vertex i of the cage was vertex
/// sourceVertices[i]; a skin is bound if there is one. `names` may name several parts.
inline Repaired afterRepair(cage::Cage cage, cage::SkinWeights weights = {}, cage::Morphs morphs = {},
                            const cage::CageNames& names = {{"cage"}, {}}) {
    Repaired result{std::move(cage), std::move(weights), std::move(morphs), {}, {}, {}};
    result.cage.sourceVertices.clear();
    for (uint32_t v = 0; v < result.cage.vertexCount(); ++v) {
        result.cage.sourceVertices.push_back(v);
    }
    std::vector<cage::Damage> damages;
    const Status status = cage::repairCage(result.cage, result.weights, result.morphs, names, damages);
    for (const cage::Damage& damage : damages) {
        result.found.push_back(damage.found);
        result.repairs.push_back(damage.repair);
    }
    if (!status) {
        result.refusal = status.error().message;
        return result;
    }
    const Result<cage::Topology> topology = cage::buildTopology(result.cage);
    EXPECT_TRUE(topology.ok()) << topology.error().message;
    EXPECT_EQ(result.cage.sourceVertices.size(), result.cage.positions.size());
    return result;
}

/// The same for a cage of which no topology can be built before.
inline Repaired repaired(cage::Cage cage, cage::SkinWeights weights = {}, cage::Morphs morphs = {}) {
    EXPECT_FALSE(cage::buildTopology(cage).ok()) << "there is no damage";
    return afterRepair(std::move(cage), std::move(weights), std::move(morphs));
}

inline Repaired repaired(std::vector<glm::vec3> positions, const Faces& polygons) {
    return repaired(supple::test::makeCage(std::move(positions), polygons));
}

/// So many vertices, no three on a line.
inline std::vector<glm::vec3> points(uint32_t count) {
    std::vector<glm::vec3> positions;
    for (uint32_t i = 0; i < count; ++i) {
        const auto x = static_cast<float>(i);
        positions.emplace_back(x, x * x, 0.3f * x * x * x);
    }
    return positions;
}

} // namespace supple::test
