// What OpenSubdiv makes of a cage before it can evaluate: limit stencils, and patches with the stencils of their
// points. The same for its evaluators on CPU and GPU. Only where OpenSubdiv is installed.
#pragma once

#include "base/result.h"
#include "cage/character.h"

#include <memory>
#include <opensubdiv/far/patchTable.h>
#include <opensubdiv/far/stencilTable.h>
#include <opensubdiv/osd/bufferDescriptor.h>
#include <opensubdiv/osd/types.h>
#include <vector>

namespace supple::bench {

/// Levels of adaptive refinement round extraordinary vertices; Gregory patches end them.
inline constexpr int kOpensubdivLevel = 3;

/// A point of a buffer: x, y, z.
inline const OpenSubdiv::Osd::BufferDescriptor kXyz(0, 3, 3);

struct OpensubdivTables {
    std::vector<float> cage;                                                 ///< x, y, z
    std::unique_ptr<const OpenSubdiv::Far::LimitStencilTable> limitStencils; ///< with first derivatives
    std::unique_ptr<const OpenSubdiv::Far::PatchTable> patches;
    std::unique_ptr<const OpenSubdiv::Far::StencilTable> refinement; ///< all points of the patches but the cage's
    std::vector<OpenSubdiv::Osd::PatchCoord> coordinates;            ///< of the points, in their order

    [[nodiscard]] size_t points() const { return coordinates.size(); }
};

/// A grid of (rate + 1)^2 points a face, u fastest. The cage has quads alone.
[[nodiscard]] Result<std::unique_ptr<OpensubdivTables>> opensubdivTables(const cage::Cage& cage, uint32_t rate);

} // namespace supple::bench
