// Smooth texture coordinates of Catmull-Clark and Loop: limits over the channel of a UV set (docs/smooth_uvs.md), in
// double.
#pragma once

#include "base/result.h"
#include "surface/refinement.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace supple::surface::fragments {

/// A sample of a face of the isolated mesh.
struct UvSample {
    glm::dvec2 value{0.0};
    glm::dvec2 u{0.0}, v{0.0}; ///< slopes: along the grid's columns and rows, a step of the grid each
};

/// What smooth texture coordinates are made of.
struct UvDemand {
    Subdivision subdivision = Subdivision::catmullClark;
    uint32_t isolationSteps = 1;
    uint32_t steps = 0; ///< beyond the isolated level
    cage::UvMode mode = cage::UvMode::cornersPlus1;
    bool folds = true; ///< see cage::buildUvChannel()
};

/// The limits of a UV set, `uvs` one per corner of the cage. Face after face of the isolated mesh: its samples, row by
/// row as its domain counts them. O(samples).
[[nodiscard]] Result<std::vector<UvSample>> limitUvs(const RefinedMesh& cage, const std::vector<glm::vec2>& uvs,
                                                     const UvDemand& demand);

} // namespace supple::surface::fragments
