// What one subdivision step does to a vertex: the weights of Catmull-Clark and Loop, with creases as in OpenSubdiv.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace supple::surface {

enum class Subdivision : uint8_t { catmullClark, loop };

/// The sharpness of boundary edges, hard creases and hard corners, which no step softens.
inline constexpr float kInfiniteSharpness = 1e9f;

/// The sharpness that is left after `steps` steps. Each takes away 1, down to 0. Infinite sharpness stays.
[[nodiscard]] float softened(float sharpness, uint32_t steps);
[[nodiscard]] std::vector<float> softened(std::span<const float> sharpness, uint32_t steps);

enum class CentreRule : uint8_t { smooth, crease, corner };

/// The rule that applies at a vertex, by the sharpness of its spokes and its own.
struct VertexRule {
    CentreRule rule = CentreRule::smooth;
    uint32_t first = 0, second = 0; ///< the two spokes of the crease
};
[[nodiscard]] VertexRule vertexRule(std::span<const float> spokeSharpness, float vertexSharpness);

/// The smooth rule: centre * c + spoke * (sum of the spoke points of ring 1) + face * (sum of its face points).
struct CentreWeights {
    double centre = 0.0, spoke = 0.0, face = 0.0;
};
[[nodiscard]] CentreWeights refineWeights(Subdivision subdivision, uint32_t valence);

/// One step: smooth * (smooth rule) + crease * (3/4 c + 1/8 (spoke first + spoke second)) + corner * c.
struct CentreStep {
    double smooth = 1.0, crease = 0.0, corner = 0.0;
    uint32_t first = 0, second = 0; ///< spokes
};
/// Both sharpnesses are those of the parent level.
[[nodiscard]] CentreStep centreStep(std::span<const float> spokeSharpness, float vertexSharpness);

} // namespace supple::surface
