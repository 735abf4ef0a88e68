// A scene of many different characters: what a frame of all of them takes, by how many there are, and what more views
// of them add.
#pragma once

#include "base/result.h"
#include "host/device.h"

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <supple/supple.h>
#include <vector>

namespace supple::bench {

struct SceneDesc {
    std::vector<uint32_t> characters; ///< different ones; a row each
    uint32_t viewedCharacters = 0;    ///< so many are seen from one, two and four views
    uint32_t frames = 0;              ///< that are measured
    bool everyUse = true;             ///< else posed at one rate and played in a view: pipelines take seconds
    SuppleMapping mapping = SUPPLE_MAPPING_AUTO;
    std::function<void(const std::string& what)> progress;
};

/// "instances" of a character; "rows": for every number of characters, at one rate and in a view, posed by the host and
/// played by the device: commands, CPU time of recording, the device's time, memory; "refused" where the view has no
/// room for so many. "views": the same characters, played, from one, two and four views.
[[nodiscard]] Result<nlohmann::ordered_json> measureScene(host::Device& device, const SceneDesc& desc);

} // namespace supple::bench
