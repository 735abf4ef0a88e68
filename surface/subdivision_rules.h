// What one step of subdivision does to a vertex: Catmull-Clark's and Loop's weights, creases by the rules of
// OpenSubdiv.
#pragma once

#include <cstdint>
#include <span>

namespace supple::surface {

enum class Subdivision : uint8_t { catmullClark, loop };

/// Sharpness of what no step softens: boundary edges, hard creases, hard corners.
inline constexpr float kInfiniteSharpness = 1e9f;

/// Sharpness after `steps` more steps: infinite stays, else less by one a step, not below 0.
[[nodiscard]] float softened(float sharpness, uint32_t steps);

enum class CentreRule : uint8_t { smooth, crease, corner };

/// The rule at a vertex by the sharpness of its spokes and its own, and the ends of its crease.
struct VertexRule {
    CentreRule rule = CentreRule::smooth;
    uint32_t first = 0, second = 0; ///< spokes
};
[[nodiscard]] VertexRule vertexRule(std::span<const float> spokeSharpness, float vertexSharpness);

/// Smooth rule of the centre: centre c + spoke (sum of ring 1's spoke points) + face (sum of its face points).
struct CentreWeights {
    double centre = 0.0, spoke = 0.0, face = 0.0;
};
[[nodiscard]] CentreWeights refineWeights(Subdivision subdivision, uint32_t valence);

/// One step of a centre: smooth * (smooth rule) + crease * (3/4 c + 1/8 (spoke first + spoke second)) + corner * c.
struct CentreStep {
    double smooth = 1.0, crease = 0.0, corner = 0.0;
    uint32_t first = 0, second = 0; ///< spokes
};
/// Sharpness at the parent level: of the spokes, and of the vertex.
[[nodiscard]] CentreStep centreStep(std::span<const float> spokeSharpness, float vertexSharpness);

} // namespace supple::surface
