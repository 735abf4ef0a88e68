// One heat: everything that is measured on a cage at a rate, in rounds of one process.
#pragma once

#include "tools/bench/cages.h"
#include "tools/bench/opensubdiv_peers.h"
#include "tools/bench/rounds.h"
#include "tools/bench/workbench.h"

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace supple::bench {

struct HeatDesc {
    const BenchCage* cage = nullptr;
    uint32_t rate = 8;
    std::span<const float> yardstick; ///< bicubic coefficients that AVX2 and plain C++ evaluate, 64 floats a patch
    RoundOptions rounds;
};

/// A row of the result: contestants with the medians of their times, ratios with the median, least and largest of the
/// rounds; "yardstick" marks ratios of Supple's own over others', which --check compares. A ratio is taken of CPU time
/// on CPU devices; on others of device time, of wall time for what runs on the host, and of both contestants' wall time
/// where one of them runs on the device and is not timed there. Schemes that refuse the cage
/// are named with their reason.
[[nodiscard]] Result<nlohmann::ordered_json> runHeat(host::Device& device, Workbench& workbench,
                                                     const OpensubdivPeers& peers, const HeatDesc& desc);

} // namespace supple::bench
