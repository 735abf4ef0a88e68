// The cloths of a character in the layout that the device reads (shaders/shared/soft.h).
#pragma once

#include "base/result.h"
#include "cage/character.h"

#include <cstdint>
#include <vector>

namespace supple::skinning {

struct ClothTable {
    std::vector<uint32_t> words;
    uint32_t clothCount = 0;    ///< 0: there are no words
    uint32_t stateElements = 0; ///< of an instance
};
/// Refuses a cloth with more vertices than a workgroup has room for, and one that takes too much in a step.
[[nodiscard]] Result<ClothTable> buildClothTable(const cage::Character& character);

} // namespace supple::skinning
