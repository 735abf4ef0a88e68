#include "tools/bench/rounds.h"

#include "tools/bench/clocks.h"

#include <algorithm>

namespace supple::bench {

namespace {

constexpr double kMaxRepeats = 2000.0;

struct Cost {
    double cpu = 0.0, wall = 0.0; ///< seconds
};

Result<Cost> measure(const Contestant& contestant, uint32_t times) {
    const double cpu = processSeconds(), wall = wallSeconds();
    const Status status = contestant.run(times);
    const Cost cost{processSeconds() - cpu, wallSeconds() - wall};
    if (!status) {
        return Error{status.error().code, contestant.name + ": " + status.error().message};
    }
    return cost;
}

Status warmUp(std::span<const Contestant> contestants, double seconds) {
    constexpr uint32_t kRuns = 4;
    const double end = wallSeconds() + seconds;
    const bool any = std::any_of(contestants.begin(), contestants.end(),
                                 [](const Contestant& contestant) { return contestant.deviceSeconds != nullptr; });
    while (any && wallSeconds() < end) {
        for (const Contestant& contestant : contestants) {
            if (!contestant.deviceSeconds) {
                continue;
            }
            if (const Result<Cost> cost = measure(contestant, kRuns); !cost) {
                return cost.error();
            }
        }
    }
    return success();
}

} // namespace

Result<std::vector<Series>> runRounds(std::span<const Contestant> contestants, const RoundOptions& options) {
    if (const Status warm = warmUp(contestants, options.warmSeconds); !warm) {
        return warm.error();
    }
    std::vector<uint32_t> repeats;
    for (const Contestant& contestant : contestants) {
        Result<Cost> cost = measure(contestant, 1); // caches fill, drivers finish compiling
        if (cost) {
            cost = measure(contestant, 1);
        }
        if (!cost) {
            return cost.error();
        }
        // On a GPU the host's CPU time says nothing about the length of the work.
        const double seconds = options.timestampsAreCheap ? cost->wall : cost->cpu;
        repeats.push_back(
            static_cast<uint32_t>(std::clamp(options.turnSeconds / std::max(seconds, 1e-7), 1.0, kMaxRepeats)));
    }
    std::vector<Series> all(contestants.size());
    for (uint32_t round = 0; round < options.rounds; ++round) {
        for (size_t c = 0; c < contestants.size(); ++c) {
            const Contestant& contestant = contestants[c];
            const Result<Cost> cost = measure(contestant, repeats[c]);
            if (!cost) {
                return cost.error();
            }
            const double aPoint = 1e9 / static_cast<double>(contestant.points);
            all[c].cpu.push_back(cost->cpu * aPoint / repeats[c]);
            all[c].wall.push_back(cost->wall * aPoint / repeats[c]);
            if (contestant.deviceSeconds) {
                const Result<double> gpu = contestant.deviceSeconds(options.timestampsAreCheap ? repeats[c] : 1);
                if (!gpu) {
                    return Error{gpu.error().code, contestant.name + ": " + gpu.error().message};
                }
                all[c].gpu.push_back(*gpu * aPoint);
            }
        }
        if (options.progress) {
            options.progress(round + 1);
        }
    }
    return all;
}

} // namespace supple::bench
