// What a click in the viewer has met of the surface.
#pragma once

#include "tools/supple/view_stage.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace supple::tools {

struct ViewPick {
    SuppleSurfacePoint point{};
    uint32_t part = 0;
    glm::vec3 position{0.0f};
    struct Joint {
        uint32_t number = 0;
        float weight = 0.0f;
    };
    std::vector<Joint> joints; ///< that move it: the heaviest first
    // Where it was met: the marker stands there while these are the stage's.
    uint32_t version = 0, clip = 0;
    double time = 0.0;
};

/// What is seen of the shown parts at a place, in fractions of the picture from its upper left. No frame may be
/// pending.
[[nodiscard]] Result<std::optional<ViewPick>> pickAt(const ViewStage& stage, const glm::vec2& place, float aspect);

/// The place of a click that does not turn the camera and that the panel does not want.
[[nodiscard]] std::optional<glm::vec2> clickedPlace();

/// A window that says what was met and what clicks attach, and a marker there. Empties the pick if the window is closed
/// or the figure is another one. Returns whether what was attached last is to be taken off.
[[nodiscard]] bool buildPick(ViewStage& stage, float aspect, std::optional<ViewPick>& pick);

} // namespace supple::tools
