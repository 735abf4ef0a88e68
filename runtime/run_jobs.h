// The host's threads as the floors below call them.
#pragma once

#include "base/run_jobs.h"

#include <supple/supple.h>

namespace supple::runtime {

/// Empty if `run` is null.
inline RunJobs runJobsOf(SuppleRunJobsFunction run, void* user) {
    if (run == nullptr) {
        return {};
    }
    return [run, user](uint32_t count, const std::function<void(uint32_t)>& job) {
        run(
            count, [](void* data, uint32_t i) { (*static_cast<const std::function<void(uint32_t)>*>(data))(i); },
            const_cast<std::function<void(uint32_t)>*>(&job), user);
    };
}

} // namespace supple::runtime
