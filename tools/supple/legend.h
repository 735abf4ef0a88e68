// What the colors of a view stand for, as a scale in the corner of its pictures.
#pragma once

#include "host/picture.h"
#include "tools/supple/view_facts.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace supple::tools {

struct Legend {
    std::string title; ///< may be empty
    struct Mark {
        float at = 0.0f; ///< 0 to 1 along the scale
        std::string text;
    };
    std::vector<Mark> marks;
    enum class Bar : uint8_t {
        none, ///< the title says it, or swatches
        scale,
        signedScale, ///< of values that may be negative; their zero lies in the middle
        gray,        ///< of bytes of a map
        stripes      ///< dark and bright, `stripes` of each
    };
    Bar bar = Bar::none;
    uint32_t stripes = 0;
    struct Swatch {
        std::array<uint8_t, 3> color{};
        std::string text;
    };
    std::vector<Swatch> swatches; ///< a line each, without a bar
};

/// Of host::shared::kView...: what its colors stand for, or why there is nothing to see. None of the shaded figure.
[[nodiscard]] std::optional<Legend> legendOf(uint32_t view, const ViewFacts& facts);

/// The bar's color from 0 to 1 along it, as shaders paint it: sRGB.
[[nodiscard]] std::array<uint8_t, 3> barColor(const Legend& legend, float at);

/// Into the lower right corner of pictures that are large enough.
void drawLegend(host::Picture& picture, const Legend& legend);

} // namespace supple::tools
