// The tangent frames of the scheme polygons: what a cage vertex's normals turn with. Private to surface/polygons/.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace supple::surface::polygons {

/// A frame at a cage vertex. It turns with the faces of one smooth group there (shaders/shared/polygons.h).
struct Frame {
    uint32_t vertex = 0;
    uint32_t toward = 0; ///< cage vertex in the direction of the tangent
    uint32_t firstFace = 0, faceCount = 0;
    glm::dmat3 axes{1.0}; ///< in the rest pose: tangent, normal x tangent, normal
};

struct Frames {
    std::vector<Frame> frames;
    std::vector<uint32_t> faces;        ///< of all frames, one after the other
    std::vector<uint32_t> cornerFrames; ///< per corner of the cage
};

/// One frame per smooth group of a vertex. If the faces of a group nearly cancel out, as on the rim of a thin sheet,
/// their sum is no direction to hold on to: then each corner has a frame that turns with its own face.
[[nodiscard]] Frames makeFrames(const cage::Cage& cage);

} // namespace supple::surface::polygons
