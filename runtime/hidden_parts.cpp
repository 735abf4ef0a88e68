#include "runtime/hidden_parts.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace supple::runtime {

HiddenParts::HiddenParts(uint32_t capacity, uint32_t partCount)
    : partCount_(partCount), stride_(maskWords(partCount)), masks_(size_t{capacity} * stride_), hiddenParts_(capacity) {
}

bool HiddenParts::set(uint32_t slot, uint32_t part, bool hidden) {
    if (hides(slot, part) == hidden) {
        return false;
    }
    masks_[size_t{slot} * stride_ + part / 32] ^= 1u << part % 32;
    const bool before = hidesAny(slot);
    hiddenParts_[slot] = hidden ? hiddenParts_[slot] + 1 : hiddenParts_[slot] - 1;
    hidingSlots_ = hidingSlots_ + (hidesAny(slot) ? 1 : 0) - (before ? 1 : 0);
    return true;
}

void HiddenParts::reset(uint32_t slot) {
    hidingSlots_ -= hidesAny(slot) ? 1 : 0;
    hiddenParts_[slot] = 0;
    std::fill_n(masks_.begin() + static_cast<ptrdiff_t>(size_t{slot} * stride_), stride_, 0u);
}

DrawnParts::DrawnParts(std::vector<PartPatches> patches) : patches_(std::move(patches)), order_(patches_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](uint32_t a, uint32_t b) { return patches_[a].all > patches_[b].all; });
}

size_t DrawnParts::write(const HiddenParts& hidden, uint32_t slots, std::byte* target) const {
    std::byte* to = target;
    for (uint32_t slot = 0; slot < slots; ++slot) {
        uint32_t patches = 0;
        for (uint32_t part = 0; part < count() && hidden.hidesAny(slot); ++part) {
            patches += hidden.hides(slot, part) ? patches_[part].atLevels : 0;
        }
        std::memcpy(to, &patches, sizeof patches);
        to += sizeof patches;
        const std::span<const std::byte> mask = std::as_bytes(hidden.mask(slot));
        to = std::copy(mask.begin(), mask.end(), to);
    }
    return static_cast<size_t>(to - target);
}

} // namespace supple::runtime
