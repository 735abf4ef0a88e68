// The patches of a surface in batches, for threads to work on.
#pragma once

#include <supple/supple.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace supple::tools {

/// Patches of one draw range that a thread takes at a time.
struct PatchBatch {
    const SuppleDrawRange* range = nullptr;
    uint32_t first = 0, last = 0; ///< patches

    /// With the vertices of the instance in slot 0.
    template <class Take>
    void forEachVertex(Take&& take) const {
        for (uint32_t patch = first; patch < last; ++patch) {
            const size_t begin = range->firstVertex + size_t{patch - range->firstPatch} * range->samplesPerPatch;
            for (size_t vertex = begin; vertex < begin + range->samplesPerPatch; ++vertex)
                take(patch, vertex);
        }
    }
};
/// In batches of a fixed size: what is found in them does not depend on the number of threads.
[[nodiscard]] std::vector<PatchBatch> patchBatches(std::span<const SuppleDrawRange> ranges);

/// Calls `work` for each batch and its number, on all cores.
void inThreads(const std::vector<PatchBatch>& batches, const std::function<void(const PatchBatch&, size_t)>& work);

} // namespace supple::tools
