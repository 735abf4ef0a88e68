// One vertex for each fan of faces. Private to cage/repair.
#pragma once

#include "cage/repair/draft.h"
#include "cage/repair/found.h"

namespace supple::cage::repair {

struct FanDamage {
    Finds bowTies;                ///< vertices of several fans that no cut edge explains
    PerPart<size_t> copiesAtCuts; ///< vertices added at the ends of cut edges
};

/// Gives every fan of faces a vertex of its own: the one with the lowest corner keeps the vertex, each other one gets a
/// copy. Copies come in the order of the vertices, then of the fans' lowest corners. A vertex of several fans becomes a
/// hard one unless cut edges explain them, so that the fans go on touching there. Where a fan passes a neighbor twice,
/// so that two edges would have the same ends, it is cut into two fans: `twins` changes so that each of these closes.
///
/// `twins` joins sides that run against each other. `atCut`: per vertex, see SheetDamage. O(corners).
void separateFans(Draft& draft, std::vector<uint32_t>& twins, const std::vector<uint8_t>& atCut, const Places& places,
                  FanDamage& damage);

} // namespace supple::cage::repair
