// The weights of a limit surface: what it gives where one point is 1 and all others are 0, three points at a time.
#pragma once

#include "cpu/limit_nets.h"
#include "cpu/point_weights.h"

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

namespace supple::cpu {

/// Weights of points that stencils make become those of what the stencils are over.
[[nodiscard]] inline PointWeights throughStencils(const PointWeights& weights, const surface::Stencils& stencils) {
    PointWeights before;
    for (const VertexWeight& entry : weights.entries()) {
        for (uint32_t i = stencils.starts[entry.vertex]; i < stencils.starts[entry.vertex + 1]; ++i) {
            VertexWeight own = stencils.weights[i] * entry;
            own.vertex = stencils.vertices[i];
            before.add(own);
        }
    }
    return before;
}

/// Fills in the weights of a place. `Limit`: the LimitSurface of Catmull-Clark or of Loop.
template <class Limit>
void weighLimit(const surface::subdivision::LimitShape& shape, const Place& place, PointWeights& out) {
    const surface::subdivision::Mesh& mesh = shape.mesh();
    const auto& fragment = mesh.fragments[Limit::sectorAt(shape, place.piece, place.x, place.y).fragment];
    const surface::subdivision::FragmentNet<double> net(mesh, {});
    const std::span<const uint32_t> vertices =
        std::span(mesh.net).subspan(fragment.firstNet, net.loadedPoints(fragment));
    std::vector<glm::dvec3> columns(vertices.size());
    PointWeights weights;
    for (uint32_t first = 0; first < vertices.size(); first += 3) {
        const uint32_t count = std::min(3u, static_cast<uint32_t>(vertices.size()) - first);
        std::fill(columns.begin(), columns.end(), glm::dvec3(0.0));
        for (uint32_t c = 0; c < count; ++c) {
            columns[first + c][static_cast<int>(c)] = 1.0;
        }
        const surface::subdivision::LimitPose pose(shape, columns);
        const auto point = Limit(pose).at(place.piece, place.x, place.y);
        for (uint32_t c = 0; c < count; ++c) {
            const int axis = static_cast<int>(c);
            weights.add({vertices[first + c], point.position[axis], point.du[axis], point.dv[axis]});
        }
    }
    for (size_t step = mesh.stencils.size(); step-- > 0;) {
        weights = throughStencils(weights, mesh.stencils[step]);
    }
    weights.turn(place);
    out = std::move(weights);
}

} // namespace supple::cpu
