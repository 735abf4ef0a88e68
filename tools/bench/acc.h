// ACC: "Approximating Catmull-Clark Subdivision Surfaces with Bicubic Patches" (C. Loop, S. Schaefer, ACM Transactions
// on Graphics 27(1), 2008), as a contender. Its surface is a bicubic patch a quad; its normals come from two fields of
// tangents, 2 x 12 coefficients, since bicubic patches alone do not meet smoothly.
#pragma once

#include "base/result.h"
#include "cage/topology.h"

#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace supple::bench {

struct AccPatch {
    std::array<glm::dvec3, 16> b; ///< index i + 4 j, i along u
    std::array<glm::dvec3, 12> u; ///< degree 2 in u, 3 in v: i + 3 j
    std::array<glm::dvec3, 12> v; ///< degree 3 in u, 2 in v: i + 4 j
};
/// A patch per face. Closed cages of quads alone.
[[nodiscard]] Result<std::vector<AccPatch>> makeAcc(const cage::Cage& cage);

struct AccSample {
    glm::dvec3 position, du, dv; ///< du and dv of the tangent fields
};
[[nodiscard]] AccSample evaluateAcc(const AccPatch& patch, double u, double v);

} // namespace supple::bench
