// The pose drivers of a character in the layout that the pose pass reads (shaders/shared/pose.h).
#pragma once

#include "cage/character.h"
#include "skinning/clip_table.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::skinning {

/// Drivers by themselves: sections are given by their first element, in `words` or in those that they are part of.
struct DriverTable {
    std::vector<uint32_t> words; ///< four an element; none: there are no drivers
    uint32_t quads = 0;
    std::vector<uint32_t> nodes; ///< by the number that inputs have for them
};
/// `places`: what inputs name by node; none: 0. `firstElement`: where the words will lie.
[[nodiscard]] DriverTable buildDriverTable(const cage::Character& character, std::span<const uint32_t> places = {},
                                           uint32_t firstElement = 0);

/// Appends them to a table that has nodes.
void putDrivers(const cage::Character& character, ClipTable& table);

} // namespace supple::skinning
