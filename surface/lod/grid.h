// Grids of a level of detail: samples of a patch at a capacity R (surface/lod/pattern.h), and the triangles between
// them.
#pragma once

#include "surface/lod/pattern.h"

#include <cstdint>
#include <vector>

namespace supple::surface::lod {

/// Forms of grids.
///
///   quad    bicubic patches, polar ones too: (R+1)^2 samples (i, j), u fastest
///   rings   patches of m sectors, m = 3, 4, 5: ring r = 0..(R-1)/2 has m (R - 2r) samples: side s = 0..m-1, then
///           k = r..R-r-1 (k = R-r is the next side's k = r); m (R+1)^2 / 4 samples in all. The sample's weights of
///           corner s, corner s+1 and the centre are (t_{R-k} - t_r, t_k - t_r, 2 t_r)
enum class Form : uint32_t {
    quad = shared::kLodQuadForm,
    triangleRings = shared::kLodTriangleForm,
    quadRings = shared::kLodQuadRingsForm,
    pentagonRings = shared::kLodPentagonForm
};

[[nodiscard]] constexpr uint32_t sides(Form form) {
    return form == Form::triangleRings ? 3 : form == Form::pentagonRings ? 5 : 4;
}
[[nodiscard]] constexpr uint32_t sampleCount(Form form, uint32_t capacity) {
    return sides(form) * (capacity + 1) * (capacity + 1) / 4;
}
/// A sample of a ring grid. Quads: side 0, r = j, k = i.
struct GridSample {
    uint32_t ring = 0;
    uint32_t side = 0;
    uint32_t k = 0;
};
[[nodiscard]] GridSample gridSample(Form form, uint32_t capacity, uint32_t sample);
/// The k-th sample (0..capacity) along side e, from corner e to the next corner.
[[nodiscard]] uint32_t edgeSample(Form form, uint32_t capacity, uint32_t side, uint32_t k);

/// Patches that one draw instance takes, so that small grids do not waste the vertex shader's lanes.
[[nodiscard]] constexpr uint32_t patchesPerDraw(Form form, uint32_t capacity) {
    const uint32_t samples = sampleCount(form, capacity);
    return samples < 64 ? 64 / samples : 1;
}

/// Triangles of patchesPerDraw() patches, counter-clockwise seen from outside. The diagonal of a cell points from the
/// nearest corner of the patch inwards, and so survives any change of capacity; the innermost ring is a fan.
[[nodiscard]] std::vector<uint16_t> gridIndices(Form form, uint32_t capacity);

} // namespace supple::surface::lod
