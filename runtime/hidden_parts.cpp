#include "runtime/hidden_parts.h"

#include <algorithm>
#include <numeric>

namespace supple::runtime {

HiddenParts::HiddenParts(uint32_t capacity, std::vector<PartPatches> patches)
    : patches_(std::move(patches)), order_(patches_.size()), stride_(wordsOf(patches_.size())),
      words_(size_t{capacity} * stride_), hiddenParts_(capacity) {
    std::iota(order_.begin(), order_.end(), 0u);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](uint32_t a, uint32_t b) { return patches_[a].all > patches_[b].all; });
}

bool HiddenParts::set(uint32_t slot, uint32_t part, bool hidden) {
    if (hides(slot, part) == hidden) {
        return false;
    }
    uint32_t* const own = &words_[size_t{slot} * stride_];
    own[1 + part / 32] ^= 1u << part % 32;
    own[0] = hidden ? own[0] + patches_[part].atLevels : own[0] - patches_[part].atLevels;
    const bool before = hidesAny(slot);
    hiddenParts_[slot] = hidden ? hiddenParts_[slot] + 1 : hiddenParts_[slot] - 1;
    hidingSlots_ = hidingSlots_ + (hidesAny(slot) ? 1 : 0) - (before ? 1 : 0);
    return true;
}

void HiddenParts::reset(uint32_t slot) {
    hidingSlots_ -= hidesAny(slot) ? 1 : 0;
    hiddenParts_[slot] = 0;
    std::fill_n(words_.begin() + static_cast<ptrdiff_t>(size_t{slot} * stride_), stride_, 0u);
}

} // namespace supple::runtime
