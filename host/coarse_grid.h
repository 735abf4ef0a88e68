// Coarser triangles over the samples of a patch, for shadows and quick pictures. Patches of all domains meet: each
// takes the same samples of a border, from whichever end they are counted.
#pragma once

#include <supple/supple.h>

#include <cstdint>
#include <vector>

namespace supple::host {

/// About half as many segments; no fewer than `fewest`, and `segments` itself if there is nothing between. `rate`: of
/// the samples.
[[nodiscard]] uint32_t halvedSegments(uint32_t segments, uint32_t rate, uint32_t fewest);

/// The sample of a border where segment `i` of `segments` begins.
[[nodiscard]] uint32_t coarseSample(uint32_t i, uint32_t segments, uint32_t rate);

/// Triangles of a patch of any domain but SUPPLE_DOMAIN_MESH.
[[nodiscard]] std::vector<uint16_t> coarseGrid(SuppleDomain domain, uint32_t rate, uint32_t segments);

} // namespace supple::host
