// The two clocks of the benchmark.
#pragma once

#include <chrono>
#include <ctime>

namespace supple::bench {

/// CPU time of the whole process: on a CPU device it covers the driver's threads, and other load does not count.
[[nodiscard]] inline double processSeconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

[[nodiscard]] inline double wallSeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace supple::bench
