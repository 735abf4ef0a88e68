// What is free of a stretch of bytes, of which pieces are taken and given back in any order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace supple::gpu {

class FreeRanges {
public:
    explicit FreeRanges(uint64_t size);

    /// Takes `bytes` (not 0) from the smallest free range that has them at a multiple of `alignment`. Nothing: none
    /// has.
    [[nodiscard]] std::optional<uint64_t> take(uint64_t bytes, uint64_t alignment);
    /// Gives back what take() has given, as a whole. Allocates nothing: pieces are given back in destructors.
    void give(uint64_t offset, uint64_t bytes) noexcept;
    [[nodiscard]] bool isWhole() const { return pieces_ == 0; } ///< nothing is taken
    [[nodiscard]] uint64_t size() const { return size_; }

private:
    struct Range {
        uint64_t first = 0, end = 0;
    };

    uint64_t size_ = 0;
    size_t pieces_ = 0;         ///< taken
    std::vector<Range> ranges_; ///< by place; no two touch, so there are at most pieces_ + 1, for which there is room
};

} // namespace supple::gpu
