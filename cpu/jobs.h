// Batches on the host's threads.
#pragma once

#include "base/result.h"
#include "base/run_jobs.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <vector>

namespace supple::cpu {

/// Calls work(begin, end) for ranges that cover 0..count, each of at most `most`. One range is run on this thread.
/// Fails if a job was not run or was asked for twice, if a host asked for one that does not exist, or if one ran out of
/// memory. A range is worked on once whatever the host does.
template <class Work>
[[nodiscard]] Status inRanges(const RunJobs& runJobs, uint32_t count, uint32_t most, const Work& work) {
    const uint32_t ranges = count / most + (count % most != 0 ? 1 : 0);
    std::atomic<bool> outOfMemory{false}, misrun{false};
    const auto runRange = [&](uint32_t range) {
        try {
            work(range * most, std::min(count - range * most, most) + range * most);
        } catch (const std::exception&) { // memory is all that fails here, and no thread of a host may see it thrown
            outOfMemory = true;
        }
    };
    if (runJobs && ranges > 1) {
        std::vector<std::atomic<bool>> begun(ranges);
        runJobs(ranges, [&](uint32_t range) {
            if (range >= ranges || begun[range].exchange(true)) {
                misrun = true;
            } else {
                runRange(range);
            }
        });
        misrun = misrun || !std::all_of(begun.begin(), begun.end(), [](const auto& one) { return one.load(); });
    } else {
        for (uint32_t range = 0; range < ranges; ++range) {
            runRange(range);
        }
    }
    if (outOfMemory) {
        return Error{ErrorCode::hostMemory, "out of memory"};
    }
    if (misrun) {
        return Error{ErrorCode::argument, "runJobs has not run each of its jobs once"};
    }
    return success();
}

} // namespace supple::cpu
