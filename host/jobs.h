// Work for all threads of the machine.
#pragma once

#include <cstdint>
#include <functional>

namespace supple::host {

/// Calls work(i) once for every i below count, on as many threads as the machine has, and returns when all have ended.
void inParallel(uint32_t count, const std::function<void(uint32_t)>& work);

/// The same as a SuppleRunJobsFunction; `user` is not used.
void runJobs(uint32_t count, void (*job)(void* jobData, uint32_t i), void* jobData, void* user);

} // namespace supple::host
