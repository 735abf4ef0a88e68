// What the checks of the exact schemes' tables have in common (surface/table_check.h). Private to chains/.
#pragma once

#include "surface/table_check_common.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace supple::surface::chains {

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
