// The crowd's character many times, posed in every frame, at update rates, with springs, and with pose drivers: what
// poses take then.
#pragma once

#include "tools/bench/workbench.h"

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace supple::bench {

struct UpdateRatesDesc {
    std::vector<uint32_t> characters;
    uint32_t frames = 0; ///< that are measured, at 60 a second
    std::function<void(const std::string& what)> progress;
};

/// A row per count of characters and interval, one where joints swing, a step a frame, one with morph targets, one
/// with drivers of these, and one where vertices jiggle. Groups of all rows record in turns. A row has medians over the
/// frames: of the milliseconds of pose and deform by timestamps, of the microseconds of recording, and of the frames'
/// own ratios to the group without update rates; and how many characters a frame poses, in the mean.
[[nodiscard]] Result<nlohmann::ordered_json> measureUpdateRates(host::Device& device, Workbench& workbench,
                                                                const UpdateRatesDesc& desc);

} // namespace supple::bench
