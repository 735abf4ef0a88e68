// Points that are rows of weights, of which some are needed: each once. Private to exact/.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <vector>

namespace supple::surface::exact {

class NeededRows {
public:
    explicit NeededRows(uint32_t all) : numbers_(all, cage::kNone) {}

    void need(uint32_t row) {
        if (numbers_[row] == cage::kNone) {
            numbers_[row] = count();
            rows_.push_back(row);
        }
    }
    [[nodiscard]] const std::vector<uint32_t>& rows() const { return rows_; }
    [[nodiscard]] uint32_t count() const { return static_cast<uint32_t>(rows_.size()); }
    /// The place among rows() of one that is needed.
    [[nodiscard]] uint32_t number(uint32_t row) const { return numbers_[row]; }

private:
    std::vector<uint32_t> numbers_, rows_;
};

} // namespace supple::surface::exact
