#include "tools/supple/surface_batches.h"

#include <algorithm>
#include <thread>

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
    const uint32_t threadCount = std::max(std::thread::hardware_concurrency(), 1u);
    std::vector<std::thread> threads;
    for (uint32_t t = 0; t < threadCount; ++t) {
        threads.emplace_back([&, t] {
            for (size_t i = t; i < batches.size(); i += threadCount)
                work(batches[i], i);
        });
    }
    for (std::thread& thread : threads)
        thread.join();
}

} // namespace supple::tools
