#include "host/jobs.h"

#include <algorithm>
#include <atomic>
#include <system_error>
#include <thread>
#include <vector>

namespace supple::host {

void inParallel(uint32_t count, const std::function<void(uint32_t)>& work) {
    std::atomic<uint32_t> next{0};
    const auto run = [&] {
        for (uint32_t i = next++; i < count; i = next++)
            work(i);
    };
    const uint32_t most = std::max(std::thread::hardware_concurrency(), 1u);
    std::vector<std::jthread> threads; // joins
    try {
        for (uint32_t t = 1; t < std::min(most, count); ++t)
            threads.emplace_back(run);
    } catch (const std::system_error&) { // with those that could be started
    }
    run();
}

void runJobs(uint32_t count, void (*job)(void* jobData, uint32_t i), void* jobData, void* user) {
    (void)user;
    inParallel(count, [&](uint32_t i) { job(jobData, i); });
}

} // namespace supple::host
