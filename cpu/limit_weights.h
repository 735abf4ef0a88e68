// The weights of a limit surface: what each point of the cage has of a place. Those of the net that the place is
// evaluated from go back level by level, so a place at a vertex of many faces takes time in proportion to their number.
#pragma once

#include "cpu/limit_nets.h"
#include "cpu/point_weights.h"

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace supple::cpu {

/// Weights of points that stencils make become those of what the stencils are over.
[[nodiscard]] PointWeights throughStencils(const PointWeights& weights, const surface::Stencils& stencils);

/// What each point of a net has of a place: of the position, of du, of dv.
using NetWeights = std::vector<glm::dvec3>;

/// Weights of the points of level `at.level` become those of the cage's vertices.
[[nodiscard]] PointWeights throughLevels(const surface::subdivision::LimitShape& shape,
                                         const surface::subdivision::SectorLevel& at, NetWeights weights);
/// The weights of the limit at the centre of a sector, which has no derivatives.
[[nodiscard]] PointWeights weighCentre(const surface::subdivision::LimitShape& shape,
                                       const surface::subdivision::SectorLevel& at);
/// How many points the net of a level has.
[[nodiscard]] uint32_t pointsOf(const surface::subdivision::LimitShape& shape,
                                const surface::subdivision::SectorLevel& at);

/// Fills in the weights of a place. `Limit`: the LimitSurface of Catmull-Clark or of Loop.
template <class Limit>
void weighLimit(const surface::subdivision::LimitShape& shape, const Place& place, PointWeights& out) {
    const surface::subdivision::SectorLevel at = Limit::levelAt(shape, place.piece, place.x, place.y);
    if (at.level == 0) {
        out = weighCentre(shape, at);
        return;
    }
    // What the surface gives where one point is 1 and all others are 0, three points at a time.
    NetWeights weights(pointsOf(shape, at));
    std::vector<glm::dvec3> columns(weights.size(), glm::dvec3(0.0));
    const surface::subdivision::LevelNet net(shape.mesh(), at.sector.fragment, at.level, columns);
    for (size_t first = 0; first < columns.size(); first += 3) {
        const size_t count = std::min<size_t>(3, columns.size() - first);
        for (size_t c = 0; c < count; ++c) {
            columns[first + c][static_cast<int>(c)] = 1.0;
        }
        const auto point = Limit::on(net, at.sector, place.x, place.y);
        for (size_t c = 0; c < count; ++c) {
            const auto axis = static_cast<int>(c);
            weights[first + c] = {point.position[axis], point.du[axis], point.dv[axis]};
            columns[first + c] = glm::dvec3(0.0);
        }
    }
    out = throughLevels(shape, at, std::move(weights));
    out.turn(place);
}

} // namespace supple::cpu
