// How sheets of several pictures look.
#pragma once

#include "host/picture.h"

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace supple::tools {

inline constexpr uint32_t kSheetGap = 6; ///< pixels between columns and rows
inline constexpr uint32_t kSheetLabelHeight = 22;
inline constexpr uint8_t kSheetPaper[] = {24, 27, 32};
inline constexpr uint8_t kSheetInk[] = {206, 211, 218};
inline constexpr uint8_t kSheetFaintInk[] = {138, 145, 156};

[[nodiscard]] inline host::Picture blankSheet(uint32_t width, uint32_t height) {
    host::Picture sheet = host::Picture::blank(width, height);
    for (size_t i = 0; i < sheet.rgba.size(); i += 4)
        std::copy(std::begin(kSheetPaper), std::end(kSheetPaper), &sheet.rgba[i]);
    return sheet;
}

} // namespace supple::tools
