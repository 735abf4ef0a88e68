// Views whose values are computed on the CPU, from a pose that was read back.
#pragma once

#include "tools/supple/limit_distance.h"
#include "tools/supple/surface_jets.h"

#include <cstdint>
#include <vector>

namespace supple::tools {

/// Whether a view (host::shared::kView...) shows values that are measured on the CPU.
[[nodiscard]] bool isMeasured(uint32_t view);

/// The values of a measured view, of every vertex. `cage`: the figure's. Any thread may call it.
[[nodiscard]] Result<std::vector<float>> measuredValues(uint32_t view, const PosedSurfaces& posed,
                                                        const cage::Cage& cage, const SurfaceRules& rules);

} // namespace supple::tools
