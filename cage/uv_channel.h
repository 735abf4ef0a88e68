// Texture coordinates as a mesh of their own: the channel of a UV set, over which schemes make smooth texture
// coordinates (docs/smooth_uvs.md). Depends on the texture coordinates and on connectivity; built once per asset.
#pragma once

#include "base/result.h"
#include "cage/features.h"
#include "cage/topology.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::cage {

/// An edge is discontinuous if at one of its ends the two faces have different values. Round a vertex, discontinuous
/// edges cut the faces into runs, and each run is a vertex of the channel. So the channel has the cage's faces and
/// corners, and seams are its borders.
struct UvChannel {
    /// What happens at a vertex of the channel.
    enum class Rule : uint8_t {
        match,  ///< whatever happens at the vertex of the cage: nothing is discontinuous there
        crease, ///< it is a control point of its border's cubic B-spline
        corner  ///< it keeps its value
    };

    Cage cage;                        ///< the given faces over the channel's vertices; positions are not used
    Topology topology;                ///< of `cage`. Its corners are the given cage's
    std::vector<glm::dvec2> values;   ///< per vertex of the channel
    std::vector<uint32_t> vertices;   ///< per vertex of the channel: the cage's
    std::vector<Rule> rules;          ///< per vertex of the channel
    std::vector<uint32_t> companions; ///< per vertex: the one whose semi-sharp edges count at a crease, or kNone
    std::vector<uint8_t> cutEdges;    ///< per edge of the given topology: 1 if it is discontinuous
};

/// What the surface says about sharpness. At kHardSharpness and more it is infinite. Boundary edges count as such.
struct UvSharpness {
    std::span<const float> edges, vertices; ///< of the topology
};

/// Builds the channel of `uvs` (one per corner), in any mode but UvMode::all. With `folds`, edges at which mirrored
/// faces meet are discontinuous too, and darts at poles are corners. O(corners log corners).
[[nodiscard]] Result<UvChannel> buildUvChannel(const Cage& cage, const Topology& topology, const UvSharpness& sharpness,
                                               std::span<const glm::vec2> uvs, UvMode mode, bool folds = true);

} // namespace supple::cage
