// The crowd's character many times in a view of levels of detail: what each pass of a frame takes.
#pragma once

#include "tools/bench/workbench.h"

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace supple::bench {

struct ViewsDesc {
    uint32_t characters = 0;
    std::vector<SuppleScheme> schemes;
    uint32_t frames = 0; ///< that are measured
    std::function<void(const std::string& what)> progress;
};

/// A row per scheme: medians over the frames of the milliseconds of a frame and of each pass by timestamps, surface
/// vertices, what a frame takes if all characters are behind the camera, and what level, place and attributes take
/// together over what evaluate takes, the median of the frames' own ratios. "aloneMs" is the least that a frame of
/// "culled" characters takes, "besideCulledMs" the same if their group has as many more behind the camera; these
/// frames are measured in turns, on CPU devices by CPU time.
[[nodiscard]] Result<nlohmann::ordered_json> measureViews(host::Device& device, Workbench& workbench,
                                                          const ViewsDesc& desc);

} // namespace supple::bench
