// Another library's evaluation of the same job, beside which Supple's is measured.
#pragma once

#include "base/result.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace supple::bench {

/// Whose limit surface is evaluated. Loop's rules take cages of triangles alone.
enum class PeerRules { catmullClark, loop };

struct Peer {
    std::string name;
    PeerRules rules = PeerRules::catmullClark;
    uint64_t points = 0;
    /// Evaluates all points and waits for the end. What it needs lives as long as this.
    std::function<Status()> run;
    /// Mean seconds by the device's own clock of so many evaluations; null for what runs on the host. 0 from drivers
    /// that do not time compute shaders.
    std::function<Result<double>(uint32_t times)> deviceSeconds;
    /// x, y, z of the points of the last run.
    std::function<std::vector<float>()> positions;
    std::shared_ptr<const std::vector<uint32_t>> faces; ///< by point: the face of the cage that it lies on, in order
};

} // namespace supple::bench
