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
    enum class Bar : uint8_t {
        scale,
        signedScale, ///< of values that may be negative; their zero lies in the middle
        stripes      ///< dark and bright, `stripes` of each
    };
    Bar bar = Bar::scale;
    uint32_t stripes = 0;
};

/// Of host::shared::kView...; most views have none.
[[nodiscard]] std::optional<Legend> legendOf(uint32_t view);

/// The bar's color from 0 to 1 along it, as shaders paint it: sRGB.
[[nodiscard]] std::array<uint8_t, 3> barColor(const Legend& legend, float at);

/// Into the lower right corner of pictures that are large enough.
void drawLegend(host::Picture& picture, const Legend& legend);

} // namespace supple::tools
