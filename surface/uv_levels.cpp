#include "surface/uv_levels.h"

#include <utility>

namespace supple::surface {
namespace {

using cage::kNone;
using cage::UvChannel;

/// At a crease that follows another run: how much of a corner it still is in a step.
double cornerShare(const RefinedMesh& mesh, uint32_t companion) {
    return centreStep(spokeSharpness(mesh, companion), mesh.vertexSharpness[companion]).corner;
}

} // namespace

std::vector<float> spokeSharpness(const RefinedMesh& mesh, uint32_t vertex) {
    std::vector<float> sharpness;
    for (uint32_t s = mesh.topology.spokeStarts[vertex]; s < mesh.topology.spokeStarts[vertex + 1]; ++s) {
        sharpness.push_back(mesh.edgeSharpness[cage::spokeEdge(mesh.cage, mesh.topology, s)]);
    }
    return sharpness;
}

std::vector<glm::dvec2> refinedValues(const Stencils& stencils, const std::vector<glm::dvec2>& values) {
    std::vector<glm::dvec2> points;
    points.reserve(stencils.rows());
    for (uint32_t row = 0; row < stencils.rows(); ++row) {
        glm::dvec2 sum(0.0);
        for (uint32_t i = stencils.starts[row]; i < stencils.starts[row + 1]; ++i) {
            sum += stencils.weights[i] * values[stencils.vertices[i]];
        }
        points.push_back(sum);
    }
    return points;
}

ChannelLevel firstChannelLevel(const RefinedMesh& cage, UvChannel channel) {
    ChannelLevel level;
    level.values = std::move(channel.values);
    level.companions = std::move(channel.companions);
    RefinedMesh& mesh = level.mesh;
    mesh.cage = std::move(channel.cage);
    mesh.topology = std::move(channel.topology);
    mesh.sourceFaces.assign(mesh.cage.faceCount(), 0);
    for (const auto& [corner, twin] : mesh.topology.edges) {
        mesh.edgeSharpness.push_back(twin == kNone ? kInfiniteSharpness
                                                   : cage.edgeSharpness[cage.topology.cornerEdges[corner]]);
    }
    for (uint32_t v = 0; v < mesh.cage.vertexCount(); ++v) {
        const bool corner = channel.rules[v] == UvChannel::Rule::corner;
        mesh.vertexSharpness.push_back(corner ? kInfiniteSharpness : cage.vertexSharpness[channel.vertices[v]]);
    }
    return level;
}

Status refineChannel(ChannelLevel& level, Subdivision subdivision, cage::UvMode mode) {
    RefinedMesh child = refine(level.mesh, subdivision);
    std::vector<glm::dvec2> values = refinedValues(child.stencils, level.values);
    for (uint32_t v = 0; v < level.companions.size(); ++v) {
        if (level.companions[v] != kNone) {
            const double share = cornerShare(level.mesh, level.companions[v]);
            values[v] += share * (level.values[v] - values[v]);
        }
    }
    const Status equipped = equip(child, level.mesh);
    if (!equipped) {
        return equipped;
    }
    if (mode == cage::UvMode::boundaries) {
        const uint32_t first = level.mesh.cage.vertexCount();
        for (uint32_t e = 0; e < level.mesh.topology.edges.size(); ++e) {
            if (level.mesh.topology.edges[e].twin == kNone) {
                child.vertexSharpness[first + e] = kInfiniteSharpness;
            }
        }
    }
    child.stencils = {};
    level.mesh = std::move(child);
    level.values = std::move(values);
    return success();
}

} // namespace supple::surface
