// Direct delta mush on the CPU in double, as the paper's formulas are written about the smoothed vertex: an account of
// its own, against which that of the library and its deform pass are tested.
#pragma once

#include "cage/character.h"
#include "skinning/delta_mush.h"
#include "skinning/pose.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <vector>

namespace supple::test {

struct MushMoments {
    double weight = 0.0;
    glm::dvec3 offset{0.0};
    glm::dmat3 spread{0.0};
};
struct MushVertex {
    bool smoothed = false; ///< else the joints move the vertex itself
    glm::dvec3 place{0.0};
    std::map<uint32_t, MushMoments> joints;
    uint32_t heaviest = 0;
};

/// Vertex by vertex: each of the smoothing's steps is solved by itself, column by column. Weights below `cut` are given
/// to the heaviest joint, and so are moments. Vertices of one place and one skin must be one vertex.
[[nodiscard]] std::vector<MushVertex> mushOneByOne(const cage::Character& character, double cut);
/// The library's.
[[nodiscard]] std::vector<MushVertex> mushOf(const skinning::DeltaMush& mush);

/// `positions`: with morph targets. `light`: the rotation is the blend of the joints'. `transform` moves the result.
[[nodiscard]] std::vector<glm::dvec3> skinByMush(std::span<const glm::dvec3> positions,
                                                 std::span<const MushVertex> mush,
                                                 std::span<const skinning::Affine> palette, bool light,
                                                 const glm::dmat4& transform = glm::dmat4(1.0));

} // namespace supple::test
