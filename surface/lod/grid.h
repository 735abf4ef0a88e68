// Grids for level of detail: the samples of a patch at a capacity R (surface/lod/pattern.h), and the triangles between
// them.
#pragma once

#include "surface/lod/pattern.h"
#include "surface/patch_class.h"

#include <cstdint>
#include <vector>

namespace supple::surface::lod {

[[nodiscard]] constexpr uint32_t sides(Form form) {
    return form == Form::triangleRings ? 3 : form == Form::pentagonRings ? 5 : 4;
}
[[nodiscard]] constexpr uint32_t sampleCount(Form form, uint32_t capacity) {
    return sides(form) * (capacity + 1) * (capacity + 1) / 4;
}

/// How many patches a draw instance has. Several small grids together do not waste the vertex shader's lanes.
[[nodiscard]] constexpr uint32_t patchesPerDraw(Form form, uint32_t capacity) {
    const uint32_t samples = sampleCount(form, capacity);
    return samples < 64 ? 64 / samples : 1;
}

/// The triangles of patchesPerDraw() patches, counter-clockwise seen from outside. The diagonal of a cell starts at the
/// patch corner that is nearest, so it is the same at every capacity. The innermost ring is a fan.
[[nodiscard]] std::vector<uint16_t> gridIndices(Form form, uint32_t capacity);

} // namespace supple::surface::lod
