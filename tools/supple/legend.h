// What the colors of a view stand for, as a scale in the corner of its pictures.
#pragma once

#include "host/picture.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace supple::tools {

struct Legend {
    std::string title;
    struct Mark {
        float at = 0.0f; ///< 0 to 1 along the scale
        std::string text;
    };
    std::vector<Mark> marks;
};

/// Of host::shared::kView...; most views have none.
[[nodiscard]] std::optional<Legend> legendOf(uint32_t view);

/// As shaders paint it: sRGB.
[[nodiscard]] std::array<uint8_t, 3> scaleColor(float value);

/// Into the lower right corner of pictures that are large enough.
void drawLegend(host::Picture& picture, const Legend& legend);

} // namespace supple::tools
