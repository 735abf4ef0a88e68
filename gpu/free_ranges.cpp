#include "gpu/free_ranges.h"

#include <iterator>

namespace supple::gpu {

std::optional<uint64_t> FreeRanges::take(uint64_t bytes, uint64_t alignment) {
    const auto aligned = [&](uint64_t offset) { return (offset + alignment - 1) / alignment * alignment; };
    auto best = ranges_.end();
    for (auto range = ranges_.begin(); range != ranges_.end(); ++range) {
        const uint64_t gap = aligned(range->first) - range->first;
        if (gap < range->second && range->second - gap >= bytes &&
            (best == ranges_.end() || range->second < best->second)) {
            best = range;
        }
    }
    if (best == ranges_.end()) {
        return std::nullopt;
    }
    const auto [first, length] = *best;
    const uint64_t offset = aligned(first), end = first + length;
    ranges_.erase(best);
    if (offset > first) {
        ranges_.emplace(first, offset - first);
    }
    if (offset + bytes < end) {
        ranges_.emplace(offset + bytes, end - offset - bytes);
    }
    free_ -= bytes;
    return offset;
}

void FreeRanges::give(uint64_t offset, uint64_t bytes) {
    free_ += bytes;
    auto behind = ranges_.lower_bound(offset);
    if (behind != ranges_.end() && behind->first == offset + bytes) {
        bytes += behind->second;
        behind = ranges_.erase(behind);
    }
    if (behind != ranges_.begin()) {
        const auto before = std::prev(behind);
        if (before->first + before->second == offset) {
            before->second += bytes;
            return;
        }
    }
    ranges_.emplace(offset, bytes);
}

} // namespace supple::gpu
