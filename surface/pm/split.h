// Cuts faces of six and more sides, for which P_m has no patch, into quads and at most one pentagon.
#pragma once

#include "base/result.h"
#include "cage/topology.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::surface::pm {

/// The cut cage has the vertices of the given one. Its faces have the order of those they came from, and their corner
/// attributes, materials and holes.
struct SplitCage {
    cage::Cage cage;
    std::vector<uint32_t> sourceFaces; ///< per face: the given face it came from
    std::vector<std::string> notes;    ///< "face 12 has 7 sides: split into a quad and a pentagon"
};

/// Cuts along zig-zag diagonals. From a start corner r they make the quads r+a, r+a+1, r-2-a, r-1-a for a = 0, 1, ...
/// until four or five corners are left. A start corner is possible if none of its diagonals is an edge already. Among
/// those the one with the shortest diagonals in the rest pose is taken, the first one if several are equal. Only the
/// first kStartCorners corners are tried. A face without a possible start corner is refused.
inline constexpr uint32_t kStartCorners = 256;
[[nodiscard]] Result<SplitCage> splitFaces(const cage::Cage& cage, const cage::Topology& topology);

} // namespace supple::surface::pm
