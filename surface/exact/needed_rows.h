// Points that are rows of weights, of which some are needed. Private to exact/.
#pragma once

#include "surface/table_writer.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <span>
#include <vector>

namespace supple::surface::exact {

/// Numbers what is needed, in the order in which it is asked for. Rows of one net lie so near each other that their
/// distance has 16 bits (writeWindow()). For that a row may have several numbers.
class NeededRows {
public:
    /// `farthest`: how far apart rows of one net may lie. A net has at most half as many.
    explicit NeededRows(uint32_t all, uint32_t farthest = 0xFFFF) : numbers_(all, cage::kNone), farthest_(farthest) {}

    uint32_t need(uint32_t row) {
        if (numbers_[row] == cage::kNone) {
            add(row);
        }
        return numbers_[row];
    }
    /// Puts numbers in the place of a net's rows: their last ones, or their first ones, or new ones.
    void needNet(std::span<uint32_t> net) {
        for (const uint32_t row : net) {
            (void)need(row);
        }
        const auto last = [&](uint32_t row) { return numbers_[row]; };
        const auto first = [&](uint32_t row) { return firstOf(numbers_[row]); };
        if (areNear(net, last)) {
            std::transform(net.begin(), net.end(), net.begin(), last);
        } else if (areNear(net, first)) {
            std::transform(net.begin(), net.end(), net.begin(), first);
        } else {
            renumber(net);
        }
    }
    /// By number. A row that has several is there as often.
    [[nodiscard]] const std::vector<uint32_t>& rows() const { return rows_; }
    [[nodiscard]] uint32_t count() const { return static_cast<uint32_t>(rows_.size()); }
    /// The last number of a row that is needed.
    [[nodiscard]] uint32_t number(uint32_t row) const { return numbers_[row]; }
    /// The further numbers of rows that have several, and the first of that row.
    [[nodiscard]] const std::map<uint32_t, uint32_t>& firsts() const { return firsts_; }

private:
    void add(uint32_t row) {
        numbers_[row] = count();
        rows_.push_back(row);
    }
    [[nodiscard]] uint32_t firstOf(uint32_t number) const {
        const auto known = firsts_.find(number);
        return known == firsts_.end() ? number : known->second;
    }
    template <class NumberOf>
    [[nodiscard]] bool areNear(std::span<const uint32_t> net, const NumberOf& numberOf) const {
        const auto byNumber = [&](uint32_t a, uint32_t b) { return numberOf(a) < numberOf(b); };
        const auto [least, most] = std::minmax_element(net.begin(), net.end(), byNumber);
        return net.empty() || numberOf(*most) - numberOf(*least) <= farthest_;
    }
    /// What lies far back comes again.
    void renumber(std::span<uint32_t> net) {
        const uint32_t back = (farthest_ + 1) / 2; // the rest is for what comes again
        const uint32_t near = count() - std::min(count(), back);
        for (uint32_t& row : net) {
            if (numbers_[row] < near) {
                const uint32_t first = firstOf(numbers_[row]);
                add(row);
                firsts_.emplace(numbers_[row], first);
            }
            row = numbers_[row];
        }
    }

    std::vector<uint32_t> numbers_, rows_;
    std::map<uint32_t, uint32_t> firsts_;
    uint32_t farthest_;
};

/// Indices of patches in the order of the mesh's faces, which lie near each other: in that order their nets are
/// numbered.
[[nodiscard]] inline std::vector<uint32_t> patchesByFacet(const std::vector<DraftPatch>& patches) {
    std::vector<uint32_t> order(patches.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return patches[a].facet < patches[b].facet; });
    return order;
}

} // namespace supple::surface::exact
