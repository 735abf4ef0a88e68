// Which points of a set lie on surface vertices (SUPPLE_POINT_SET_ON_VERTICES).
#pragma once

#include "base/result.h"
#include "runtime/surfaces.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::runtime {

class CpuGroup;

struct VertexPoints {
    /// Those of a surface at a rate (Tessellation::gridRate).
    struct Run {
        uint32_t surface = 0, rate = 0;
        uint32_t first = 0, count = 0;
    };
    std::vector<uint32_t> words; ///< two each (shaders/shared/points.h)
    std::vector<Run> runs;
};

/// At all rates that the surfaces may have. `group`: the same surfaces on the CPU, which have the points. Refuses
/// surfaces that have no vertices at a rate.
[[nodiscard]] Result<VertexPoints> vertexPoints(const CpuGroup& group, const Surfaces& surfaces,
                                                std::span<const SuppleSurfacePoint> points);

} // namespace supple::runtime
