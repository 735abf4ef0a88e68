// What stands round the figures to be mirrored: the studio's soft boxes, walls and floor, blurred for every roughness.
#pragma once

#include "host/device.h"

#include <glm/glm.hpp>
#include <vector>

namespace supple::host {

/// Four scalar masks over the sphere of directions, for a viewer at yaw 0. They are blurred apart, so that each light
/// has its own color and its own shadow when it is mirrored. x: the key's soft box. y: the rim's. z: what hangs
/// overhead, and a card beside the viewer. w: 1 above the horizon, 0 on the floor.
struct StudioEnvironment {
    /// Octahedral maps, the sharpest first: shared::kEnvironmentSize texels a side, then half of the level before. The
    /// outermost texels lie on the border of the octahedron, where directions meet, so that no seam shows.
    std::vector<std::vector<glm::vec4>> levels;
    /// What turns the irradiance of the key and the rim into the radiance of their boxes.
    float keyRadiance = 1.0f;
    float rimRadiance = 1.0f;
};

/// The direction of a texel of a level, and the place of a direction, as shaders/studio.glsl has them.
[[nodiscard]] glm::vec3 octahedralDirection(glm::vec2 at); ///< at: -1..1
[[nodiscard]] glm::vec2 octahedralPlace(glm::vec3 direction);

/// The roughness that a level is blurred for, from 0 to 1.
[[nodiscard]] float environmentRoughness(uint32_t level);

[[nodiscard]] StudioEnvironment studioEnvironment();

/// In SHADER_READ_ONLY_OPTIMAL. Waits for the device.
[[nodiscard]] Result<Image> uploadEnvironment(Device& device, const StudioEnvironment& environment);

} // namespace supple::host
