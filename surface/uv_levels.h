// The channel of a UV set, refined step by step (docs/smooth_uvs.md): its vertices follow the rules of the cage's, and
// their own along seams.
#pragma once

#include "cage/uv_channel.h"
#include "surface/refinement.h"

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::surface {

/// The channel after some steps.
struct ChannelLevel {
    RefinedMesh mesh; ///< positions and stencils are not used
    std::vector<glm::dvec2> values;
    /// Per vertex: the one whose semi-sharp edges count at a crease, or kNone (UvChannel::companions). Vertices of the
    /// channel itself come first at every level.
    std::vector<uint32_t> companions;
};

/// `cage`: what the channel was built of, with what it says about sharpness.
[[nodiscard]] ChannelLevel firstChannelLevel(const RefinedMesh& cage, cage::UvChannel channel);
/// One step. Faces get the order of refine().
[[nodiscard]] Status refineChannel(ChannelLevel& level, Subdivision subdivision, cage::UvMode mode);

/// The values of a step, of those of the level before; companions are not looked at.
[[nodiscard]] std::vector<glm::dvec2> refinedValues(const Stencils& stencils, const std::vector<glm::dvec2>& values);

/// The sharpness of a vertex's spokes.
[[nodiscard]] std::vector<float> spokeSharpness(const RefinedMesh& mesh, uint32_t vertex);

} // namespace supple::surface
