// Faces of six and more sides, cut into quads and at most one pentagon: P_m has no patch for them.
#pragma once

#include "base/result.h"
#include "cage/topology.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::surface::pm {

/// The cut cage has the vertices of the given one; its faces stand in the order of those they came from, with their
/// corners' attributes, materials and holes.
struct SplitCage {
    cage::Cage cage;
    std::vector<uint32_t> sourceFaces; ///< per face: the given face it came from
    std::vector<std::string> notes;    ///< "face 12 has 7 sides: split into a quad and a pentagon"
};

/// Cuts along zig-zag diagonals: from a start corner r, quads r+a, r+a+1, r-2-a, r-1-a for a = 0, 1, ... until four or
/// five corners are left. Of the start corners whose diagonals are no edges yet, that with the shortest diagonals in
/// the rest pose; the first one of equals. Refuses a face that has no such corner. Of faces with more than
/// kStartCorners sides only the first so many corners are tried.
inline constexpr uint32_t kStartCorners = 256;
[[nodiscard]] Result<SplitCage> splitFaces(const cage::Cage& cage, const cage::Topology& topology);

} // namespace supple::surface::pm
