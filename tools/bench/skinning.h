// The deform pass alone by every way of skinning.
#pragma once

#include "tools/bench/cages.h"
#include "tools/bench/rounds.h"
#include "tools/bench/workbench.h"

#include <nlohmann/json_fwd.hpp>

namespace supple::bench {

struct SkinningDesc {
    const BenchCage* cage = nullptr; ///< its character has joints
    uint32_t characters = 0;
    RoundOptions rounds;
};

/// A row: for each way of skinning the median time of a vertex, and its ratio over dual quaternions within a round, of
/// CPU time on CPU devices, else of device time. All characters are in the bind pose: no pose costs more than another.
[[nodiscard]] Result<nlohmann::ordered_json> measureSkinning(host::Device& device, Workbench& workbench,
                                                             const SkinningDesc& desc);

} // namespace supple::bench
