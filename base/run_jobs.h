// Work on the host's threads. Supple has none of its own.
#pragma once

#include <cstdint>
#include <functional>

namespace supple {

/// Calls job(i) once for every i below count, in any order and on any threads, and returns when all have returned.
using RunJobs = std::function<void(uint32_t count, const std::function<void(uint32_t)>& job)>;

} // namespace supple
