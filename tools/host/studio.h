// The light the figures stand in: a warm key, a cool rim, a sky of many directions, each with its own shadow map.
#pragma once

#include "shaders/shared/draw.h"
#include "tools/host/camera.h"

#include <cstdint>
#include <vector>

namespace supple::host {

/// How many directions sample each part of the rig. More are softer and dearer: every one is a shadow map.
struct StudioQuality {
    uint32_t key = 10;
    uint32_t rim = 3;
    uint32_t sky = 18;
    uint32_t shadowSize = 1024; ///< texels a side of each shadow map

    [[nodiscard]] uint32_t lightCount() const { return key + rim + sky; }

    /// For pictures.
    [[nodiscard]] static StudioQuality still() { return {}; }
    /// For a window: on a CPU device a few directions must do.
    [[nodiscard]] static StudioQuality interactive(bool cpuDevice) {
        return cpuDevice ? StudioQuality{2, 1, 4, 512} : StudioQuality{8, 2, 14, 1024};
    }
};

/// The rig for a figure inside the sphere, seen from `yaw` (see Camera): the key stands to the viewer's left, the rim
/// behind the figure to the right.
[[nodiscard]] std::vector<shared::Light> studioLights(const StudioQuality& quality, float yaw, glm::vec3 center,
                                                      float radius);

} // namespace supple::host
