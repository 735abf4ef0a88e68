// Points on the surfaces of a crowd: what the pass takes that finds their frames.
#pragma once

#include "tools/bench/workbench.h"

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace supple::bench {

struct PointsDesc {
    std::vector<uint32_t> characters;
    uint32_t points = 0; ///< of each
    uint32_t frames = 0; ///< that are measured
    std::function<void(const std::string& what)> progress;
};

/// A row per count of characters, which play and have the surface of catmull-clark, at rate 1: medians over the frames
/// of the milliseconds of the passes points and deform, and the nanoseconds a point. Nothing if the library has no
/// surfaces on the CPU.
[[nodiscard]] Result<nlohmann::ordered_json> measurePoints(host::Device& device, Workbench& workbench,
                                                           const PointsDesc& desc);

} // namespace supple::bench
