#include "gpu/free_ranges.h"

#include <algorithm>
#include <iterator>

namespace supple::gpu {

namespace {

constexpr size_t kFirstRanges = 8;

} // namespace

FreeRanges::FreeRanges(uint64_t size) : size_(size) {
    ranges_.reserve(kFirstRanges);
    ranges_.push_back({0, size});
}

std::optional<uint64_t> FreeRanges::take(uint64_t bytes, uint64_t alignment) {
    const auto aligned = [&](uint64_t offset) { return (offset + alignment - 1) / alignment * alignment; };
    auto best = ranges_.end();
    for (auto range = ranges_.begin(); range != ranges_.end(); ++range) {
        const bool fits = aligned(range->first) < range->end && range->end - aligned(range->first) >= bytes;
        if (fits && (best == ranges_.end() || range->end - range->first < best->end - best->first)) {
            best = range;
        }
    }
    if (best == ranges_.end()) {
        return std::nullopt;
    }
    if (const size_t most = pieces_ + 2; most > ranges_.capacity()) {
        const auto place = std::distance(ranges_.begin(), best);
        ranges_.reserve(2 * most);
        best = ranges_.begin() + place;
    }
    const Range before{best->first, aligned(best->first)}, behind{before.end + bytes, best->end};
    ++pieces_;
    if (before.first == before.end && behind.first == behind.end) {
        ranges_.erase(best);
    } else if (before.first == before.end) {
        *best = behind;
    } else {
        *best = before;
        if (behind.first < behind.end) {
            ranges_.insert(std::next(best), behind);
        }
    }
    return before.end;
}

void FreeRanges::give(uint64_t offset, uint64_t bytes) noexcept {
    const uint64_t end = offset + bytes;
    const auto behind = std::lower_bound(ranges_.begin(), ranges_.end(), offset,
                                         [](const Range& range, uint64_t at) { return range.first < at; });
    const bool joinsBehind = behind != ranges_.end() && behind->first == end;
    const bool joinsBefore = behind != ranges_.begin() && std::prev(behind)->end == offset;
    --pieces_;
    if (joinsBefore && joinsBehind) {
        std::prev(behind)->end = behind->end;
        ranges_.erase(behind);
    } else if (joinsBefore) {
        std::prev(behind)->end = end;
    } else if (joinsBehind) {
        behind->first = offset;
    } else {
        ranges_.insert(behind, {offset, end});
    }
}

} // namespace supple::gpu
