// What OpenSubdiv makes of a cage before it can evaluate: limit stencils, and patches with the stencils of their
// points. The same for its evaluators on CPU and GPU. Only where OpenSubdiv is installed.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "tools/bench/opensubdiv_peers.h"

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
    std::shared_ptr<const std::vector<uint32_t>> faces;              ///< of the points
    PeerRules rules = PeerRules::catmullClark;

    [[nodiscard]] size_t points() const { return coordinates.size(); }
};

/// Grids of points, u fastest. By Catmull-Clark's rules a quad has (rate + 1)^2, and any other face n times
/// (rate / 2 + 1)^2, one grid a corner; the rate is even. By Loop's rules a triangle has (rate + 1) (rate + 2) / 2.
/// Holes have none. Errors are those of OpensubdivPeers::make().
[[nodiscard]] Result<std::unique_ptr<OpensubdivTables>> opensubdivTables(const cage::Cage& cage, PeerRules rules,
                                                                         uint32_t rate);

} // namespace supple::bench
