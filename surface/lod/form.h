// Forms of the grids that patches are drawn with at levels.
#pragma once

#include "shaders/shared/lod.h"

#include <cstdint>

namespace supple::surface::lod {

/// Forms of grids.
///
///   quad    bicubic patches, including polar ones: (R+1)^2 samples (i, j), u fastest
///   rings   patches of m sectors, m = 3, 4, 5: ring r = 0..(R-1)/2 has m (R - 2r) samples: side s = 0..m-1, then
///           k = r..R-r-1 (k = R-r is the next side's k = r); m (R+1)^2 / 4 samples in all. The sample's weights of
///           corner s, corner s+1 and the centre are (t_{R-k} - t_r, t_k - t_r, 2 t_r)
enum class Form : uint32_t {
    quad = shared::kLodQuadForm,
    triangleRings = shared::kLodTriangleForm,
    quadRings = shared::kLodQuadRingsForm,
    pentagonRings = shared::kLodPentagonForm
};

} // namespace supple::surface::lod
