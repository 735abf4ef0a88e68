// Centers of rotation: the points of the rest pose about which cage vertices of several joints turn (Le, Hodgins 2016).
#pragma once

#include "cage/character.h"

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::skinning {

/// So many influences of a vertex count for its center: the heaviest.
inline constexpr size_t kCenterInfluences = 8;

struct Centers {
    std::vector<glm::vec4> points; ///< one per cage vertex: (x, y, z, 1); or zeros: it has none and is skinned linearly
    /// By joint: how far vertices that it moves are from their centers at most; 0 if none of them has one.
    std::vector<double> arms;

    /// With the arms that follow from the points.
    [[nodiscard]] static Centers of(const cage::Character& character, std::vector<glm::vec4> points);
};

/// Averages the surface of the cage, each place with its area times how much its weights are like the vertex':
///
///     c_i = sum_t s(i, t) a_t x_t / sum_t s(i, t) a_t
///     s(i, t) = sum_{j<k} 2 w_ij w_ik v_tj v_tk exp(-((w_ij v_tk - w_ik v_tj) / sigma)^2)
///
/// over the triangles of all faces, cut once at the middles of their edges; v_t: mean weights of a triangle. A vertex
/// of one joint has no center. Triangles of like weights are taken together, so that a cage takes no longer than its
/// vertices times some hundreds. Sums are in double, in one order.
[[nodiscard]] Centers findCenters(const cage::Character& character);

} // namespace supple::skinning
