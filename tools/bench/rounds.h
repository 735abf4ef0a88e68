// Interleaved rounds: all contestants of a heat take turns in one process, so that a slow phase of the machine meets
// them all. What counts is the ratio within a round.
#pragma once

#include "base/result.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace supple::bench {

/// One thing measured.
struct Contestant {
    std::string name;
    uint64_t points = 0;
    /// Does the work so many times and waits for the end of each.
    std::function<Status(uint32_t times)> run;
    /// Mean seconds on the device by its timestamps, measured apart from run(); null for what has none.
    std::function<Result<double>(uint32_t times)> deviceSeconds;
};

/// Nanoseconds a point, one value a round.
struct Series {
    std::vector<double> cpu;  ///< of the process
    std::vector<double> wall; ///< of the clock on the wall
    std::vector<double> gpu;  ///< by timestamps; empty for what has none
};

struct RoundOptions {
    uint32_t rounds = 7;
    double turnSeconds = 0.02;      ///< CPU time a turn should last: work is repeated until the clocks see it
    bool timestampsAreCheap = true; ///< on CPU devices they are not, and are taken once a turn
    double warmSeconds = 0.0;       ///< of work on the device before it is measured: idle GPUs lower their clocks
    std::function<void(uint32_t round)> progress;
};

/// One Series a contestant.
[[nodiscard]] Result<std::vector<Series>> runRounds(std::span<const Contestant> contestants,
                                                    const RoundOptions& options);

} // namespace supple::bench
