// Direct delta mush (Le, Lewis 2019): skin weights smoothed over the cage, with what a vertex must know of its
// neighborhood to turn as it does.
#pragma once

#include "base/result.h"
#include "cage/character.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace supple::skinning {

/// Smoothed weights below this are given to the heaviest joint.
inline constexpr double kMushCut = 0.001;
/// So many joints a vertex has at most: the heaviest.
inline constexpr size_t kMostMushInfluences = 32;

/// Moments of what a joint moves of a vertex' neighborhood, about the vertex' smoothed place p:
///
///     weight = sum_k b_ik w_kj    offset = sum_k b_ik w_kj (u_k - p)    spread = sum_k b_ik w_kj (u_k - p)(u_k - p)^T
///
/// with the rest positions u and weights w, and the share b_ik that vertex k has of vertex i when the cage is smoothed.
struct MushInfluence {
    uint32_t joint = 0;
    float weight = 0.0f;
    glm::vec3 offset{0.0f};
    std::array<float, 6> spread{}; ///< xx, xy, xz, yy, yz, zz

    bool operator==(const MushInfluence&) const = default;
};

struct DeltaMush {
    std::vector<glm::vec4> places; ///< per cage vertex: (p, 1); or zeros: it is not smoothed, and skinned linearly
    std::vector<uint32_t> starts;  ///< vertexCount + 1 entries
    std::vector<MushInfluence> influences; ///< vertex by vertex, the heaviest first; at least one
    /// By joint: a bound for how far vertices that it moves are from where linear skinning may take others, in the rest
    /// pose's lengths: the way to their smoothed places, and what the cut has left over.
    std::vector<double> arms;

    /// With the arms that follow from the others.
    [[nodiscard]] static DeltaMush of(const cage::Character& character, std::vector<glm::vec4> places,
                                      std::vector<uint32_t> starts, std::vector<MushInfluence> influences);
};

/// By the smoothing that the character's parts ask for, and its mask. Sums are in double, in one order. Refuses cages
/// that would take too long: of very many vertices with very many joints.
[[nodiscard]] Result<DeltaMush> findDeltaMush(const cage::Character& character);

} // namespace supple::skinning
