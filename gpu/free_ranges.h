// What is free of a stretch of bytes, of which pieces are taken and given back in any order.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace supple::gpu {

class FreeRanges {
public:
    explicit FreeRanges(uint64_t size) : size_(size), free_(size) { ranges_.emplace(0, size); }

    /// Takes `bytes` (not 0) from the smallest free range that has them at a multiple of `alignment`. Nothing: none
    /// has.
    [[nodiscard]] std::optional<uint64_t> take(uint64_t bytes, uint64_t alignment);
    /// Gives back what take() has given, as a whole.
    void give(uint64_t offset, uint64_t bytes);
    [[nodiscard]] bool isWhole() const { return free_ == size_; } ///< nothing is taken
    [[nodiscard]] uint64_t size() const { return size_; }

private:
    uint64_t size_ = 0, free_ = 0;
    std::map<uint64_t, uint64_t> ranges_; ///< by offset: how many bytes; no two touch
};

} // namespace supple::gpu
