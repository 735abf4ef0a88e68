// Which parts of a character each instance hides, and what that means for the surfaces of a group.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace supple::runtime {

/// The instances that a draw range draws, if some hide its part: entries of the instance list that draws read.
struct PartList {
    uint32_t first = 0;
    uint32_t count = 0;
};

/// How many patches a part has.
struct PartPatches {
    uint32_t all = 0;
    uint32_t atLevels = 0; ///< of a view
};

/// A mask per slot. Nothing is allocated after the constructor.
class HiddenParts {
public:
    HiddenParts() = default;
    HiddenParts(uint32_t capacity, uint32_t partCount);

    [[nodiscard]] uint32_t partCount() const { return partCount_; }
    /// Whether that is a change.
    bool set(uint32_t slot, uint32_t part, bool hidden);
    /// The slot hides nothing.
    void reset(uint32_t slot);

    [[nodiscard]] bool hides(uint32_t slot, uint32_t part) const {
        return (mask(slot)[part / 32] >> (part % 32) & 1u) != 0;
    }
    [[nodiscard]] bool hidesAny(uint32_t slot) const { return hiddenParts_[slot] > 0; }
    /// Whether any slot hides anything.
    [[nodiscard]] bool any() const { return hidingSlots_ > 0; }

    [[nodiscard]] static uint32_t maskWords(size_t parts) { return static_cast<uint32_t>((parts + 31) / 32); }
    /// A bit per part.
    [[nodiscard]] std::span<const uint32_t> mask(uint32_t slot) const {
        return std::span(masks_).subspan(size_t{slot} * stride_, stride_);
    }

private:
    uint32_t partCount_ = 0;
    uint32_t stride_ = 0; ///< words of a mask
    std::vector<uint32_t> masks_;
    std::vector<uint32_t> hiddenParts_; ///< by slot: how many
    uint32_t hidingSlots_ = 0;
};

/// The parts as the surfaces of a group draw them. Groups that share instances have patches of their own.
class DrawnParts {
public:
    DrawnParts() = default;
    /// `patches`: of every part.
    explicit DrawnParts(std::vector<PartPatches> patches);

    [[nodiscard]] uint32_t count() const { return static_cast<uint32_t>(patches_.size()); }
    /// The parts, those with the most patches first. If lists of instances follow each other in this order, the k-th is
    /// drawn with at most 1/k of an instance's patches. So an entry's number times the patches that are drawn with it
    /// stays below three times all patches of all instances, which fits 32 bits.
    [[nodiscard]] std::span<const uint32_t> order() const { return order_; }

    // As the device reads them: per slot the number of hidden patches at levels, then a bit per part.
    [[nodiscard]] static uint32_t wordsOf(size_t parts) { return 1 + HiddenParts::maskWords(parts); }
    /// Writes the first `slots` slots; the bytes.
    size_t write(const HiddenParts& hidden, uint32_t slots, std::byte* target) const;

private:
    std::vector<PartPatches> patches_;
    std::vector<uint32_t> order_;
};

} // namespace supple::runtime
