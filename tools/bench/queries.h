// Rays at a crowd: what the queries of a frame take on the device, beside suppleFindPoints.
#pragma once

#include "tools/bench/workbench.h"

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace supple::bench {

struct QueriesDesc {
    std::vector<uint32_t> characters;
    std::vector<uint32_t> rays; ///< of a frame
    uint32_t frames = 0;        ///< that are measured
    std::function<void(const std::string& what)> progress;
};

/// A row per count of characters, which play side by side and have the surface of catmull-clark, and count of rays,
/// which are aimed at them in turn: medians over the frames of the milliseconds of pass queries; what suppleFindPoints
/// takes for the same rays with the cages of the characters at hand, on one core; and how many times that is the
/// former. Nothing if the library has no surfaces on the CPU.
[[nodiscard]] Result<nlohmann::ordered_json> measureQueries(host::Device& device, Workbench& workbench,
                                                            const QueriesDesc& desc);

} // namespace supple::bench
