// What the checks of the exact schemes' tables have in common (surface/table_check.h). Private to chains/.
#pragma once

#include "surface/table_check.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace supple::surface::chains {

/// Whether kernels may write so many coefficients of an instance. What tells the last level of its chains
/// (LodTables::depth) they may not touch: chains are followed as far as it says.
[[nodiscard]] inline bool checkTarget(TableCheck& check, uint64_t first, uint64_t count = 1) {
    const uint64_t depth = check.tables().lod.depth;
    return check.pool(first, count) && check.require(depth == 0 || depth < first || depth - first >= count,
                                                     "written where the last level of chains stands");
}

/// The largest of the first `count` numbers of 16 bits, two a word.
[[nodiscard]] inline uint32_t largestHalf(const uint32_t* words, uint32_t count) {
    uint32_t low = 0, high = 0;
    for (uint32_t k = 0; k < count / 2; ++k) {
        low = std::max(low, words[k] & 0xFFFFu);
        high = std::max(high, words[k] >> 16);
    }
    if (count % 2 != 0) {
        low = std::max(low, words[count / 2] & 0xFFFFu);
    }
    return std::max(low, high);
}

/// A bit for every element of the tables: what several records name is followed once.
class SeenElements {
public:
    explicit SeenElements(const Tables& tables) : bits_(tables.words.size() / 4 / kBits + 1, 0) {}

    /// Whether it is the first time. The tables have the element.
    [[nodiscard]] bool isFirst(uint64_t element) {
        uint64_t& bits = bits_[element / kBits];
        const uint64_t bit = uint64_t{1} << element % kBits;
        const bool first = (bits & bit) == 0;
        bits |= bit;
        return first;
    }

private:
    static constexpr uint64_t kBits = 64;
    std::vector<uint64_t> bits_;
};

} // namespace supple::surface::chains
