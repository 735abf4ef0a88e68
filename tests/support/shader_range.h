// What shaders are told of a draw range.
#pragma once

#include "supple/supple.h"

#include <cstdint>

namespace supple::test {

/// SuppleRange of shaders/supple_surface.glsl.
struct ShaderRange {
    uint32_t patchCount = 0;
    uint32_t firstVertex = 0;
    uint32_t samplesPerPatch = 0;
    uint32_t verticesPerInstance = 0;
    uint32_t firstSlot = 0;
    uint32_t previousWords = 0;
};

[[nodiscard]] inline ShaderRange shaderRange(const SuppleGridOutput& grid, uint32_t index) {
    const SuppleDrawRange& from = grid.drawRanges[index];
    return {from.patchCount, from.firstVertex, from.samplesPerPatch, grid.verticesPerInstance, 0, 0};
}

} // namespace supple::test
