// Runs of supple profile over several numbers of instances, and over several rates.
#pragma once

#include "tools/supple/profile_stage.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::tools {

/// A number that runs go through, and its values.
struct Sweep {
    bool ofRate = false; ///< else of instances
    std::vector<uint32_t> values;
};
/// "instances=1,10,100" or "rate=4,8".
[[nodiscard]] Result<Sweep> parseSweep(const std::string& text);

/// What a run is made with each: the options' own or, if there are sweeps, each value of each of them.
[[nodiscard]] std::vector<ProfileOptions> settingsOf(const ProfileOptions& options);

/// Of a rate or a number of instances that is given, but that no sweep leaves as it is; empty: none.
[[nodiscard]] std::string unusedBySweeps(const ProfileOptions& options, bool givesRate, bool givesInstances);

} // namespace supple::tools
