// What the shaders know of a frame: the camera that goes round the middle, and the sun.
#pragma once

#include "settings.h"

#include <array>
#include <vector>

namespace qt_quick {

/// As in shaders/frame.glsl.
struct FrameUniforms {
    std::array<float, 16> viewProjection;
    std::array<float, 16> sunViewProjection;
    std::array<float, 4> eye;
    std::array<float, 4> sun;      ///< towards it
    std::array<float, 4> viewport; ///< one over width and height; the number of feet; the middle, across
    std::array<float, 4> feet[kMaxCount];
};

FrameUniforms frameUniforms(const Settings& settings, uint32_t width, uint32_t height,
                            const std::vector<std::array<float, 4>>& feet);

} // namespace qt_quick
