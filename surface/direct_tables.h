// What hosts' shaders evaluate patches from while they draw (shaders/supple_patch_layout.h): the records of a scheme's
// tables without the rest of them, and the parameters of samples.
#pragma once

#include "surface/scheme.h"

#include <cstdint>
#include <vector>

namespace supple::surface {

struct DirectTables {
    /// Whole elements: the pairs of all rates up to the most, where SUPPLE_FIRST_PAIR says; then the records.
    std::vector<uint32_t> words;
    std::vector<uint32_t> firstRecords; ///< by patch range: the element
};
/// All patches are bicubic or P_m's.
[[nodiscard]] DirectTables directTables(const Tables& tables, uint32_t mostRate);

} // namespace supple::surface
