#include "tools/supple/surface_batches.h"

#include "host/jobs.h"

#include <algorithm>

namespace supple::tools {

std::vector<PatchBatch> patchBatches(std::span<const SuppleDrawRange> ranges) {
    constexpr uint32_t kBatch = 256;
    std::vector<PatchBatch> batches;
    for (const SuppleDrawRange& range : ranges) {
        const uint32_t end = range.firstPatch + range.patchCount;
        for (uint32_t first = range.firstPatch; first < end; first += kBatch)
            batches.push_back({&range, first, std::min(first + kBatch, end)});
    }
    return batches;
}

void inThreads(const std::vector<PatchBatch>& batches, const std::function<void(const PatchBatch&, size_t)>& work) {
    host::inParallel(static_cast<uint32_t>(batches.size()), [&](uint32_t i) { work(batches[i], i); });
}

} // namespace supple::tools
