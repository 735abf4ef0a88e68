// The light the figures stand in: a warm key, a cool rim, a sky of many directions, each with its own shadow map.
#pragma once

#include "host/camera.h"
#include "host/shaders/draw.h"

#include <cstdint>
#include <vector>

namespace supple::host {

/// How many directions sample each part of the rig. More are softer and dearer: every one is a shadow map.
struct StudioQuality {
    uint32_t key = 5;
    uint32_t rim = 2;
    uint32_t sky = 9;
    uint32_t shadowSize = 1024; ///< texels a side of each shadow map
    uint32_t passes = 4;        ///< pictures, each with other directions and places in the pixel, averaged into one
    bool multisample = true;    ///< where the device can

    [[nodiscard]] uint32_t lightCount() const { return key + rim + sky; }

    /// For pictures of this height; small ones show less of it. A CPU device multisamples at three times the price:
    /// there more passes do it.
    [[nodiscard]] static StudioQuality still(uint32_t height, bool cpuDevice) {
        const bool small = height <= 480;
        if (cpuDevice)
            return {
                .key = 2, .rim = 1, .sky = 4, .shadowSize = small ? 512u : 1024u, .passes = 7, .multisample = false};
        return {.shadowSize = small ? 512u : 1024u};
    }
    /// For a window: on a CPU device a few directions must do.
    [[nodiscard]] static StudioQuality interactive(bool cpuDevice) {
        if (cpuDevice)
            return {.key = 1, .rim = 1, .sky = 4, .shadowSize = 768, .passes = 1, .multisample = false};
        return {.key = 8, .rim = 2, .sky = 14, .shadowSize = 1024, .passes = 1};
    }
    /// For a window of a CPU device while something moves: only the key throws a shadow.
    [[nodiscard]] static StudioQuality fast() {
        return {.key = 1, .rim = 0, .sky = 0, .shadowSize = 512, .passes = 1, .multisample = false};
    }
    /// For a window of a CPU device where nothing moves: as many directions as still() has, in passes short enough to
    /// be left at any time.
    [[nodiscard]] static StudioQuality refining() {
        return {.key = 1, .rim = 1, .sky = 1, .shadowSize = 768, .passes = 32, .multisample = false};
    }
};

/// How deep a shadow map is, in radii of the scene.
inline constexpr float kShadowDepth = 2.2f;

/// The rig for a figure inside the sphere, seen from `yaw` (see Camera): the key stands to the viewer's left, the rim
/// behind the figure to the right. All passes together sample each part of the rig evenly, and so does every one of
/// them.
[[nodiscard]] std::vector<shared::Light> studioLights(const StudioQuality& quality, uint32_t pass, float yaw,
                                                      glm::vec3 center, float radius);
/// The middles of the key and the rim, each with all its light: what highlights are drawn from.
struct StudioMiddle {
    glm::vec3 keyDirection, keyColor, rimDirection, rimColor;
};
[[nodiscard]] StudioMiddle studioMiddle(float yaw);
/// What the sky sends to a surface that faces straight up, if nothing hides it.
[[nodiscard]] glm::vec3 studioOpenSky();
/// Where in the pixel a pass samples: an offset in pixels, within half a pixel.
[[nodiscard]] glm::vec2 studioJitter(const StudioQuality& quality, uint32_t pass);
/// Brings figures as dark as coal and as light as chalk a little nearer to a middle brightness.
[[nodiscard]] float studioExposure(float averageAlbedo);

} // namespace supple::host
