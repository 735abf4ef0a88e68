// Another library's evaluation of the same job, beside which Supple's is measured.
#pragma once

#include "base/result.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace supple::bench {

struct Peer {
    std::string name;
    uint64_t points = 0;
    /// Evaluates all points and waits for the end. What it needs lives as long as this.
    std::function<Status()> run;
    /// Mean seconds by the device's own clock of so many evaluations; null for what runs on the host. 0 from drivers
    /// that do not time compute shaders.
    std::function<Result<double>(uint32_t times)> deviceSeconds;
    /// x, y, z of the points of the last run, (rate + 1)^2 a face, faces in order.
    std::function<std::vector<float>()> positions;
};

} // namespace supple::bench
