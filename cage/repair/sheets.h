// Which faces are joined across which edges, and which way round every face is. Private to cage/repair.
#pragma once

#include "cage/repair/draft.h"
#include "cage/repair/found.h"

namespace supple::cage::repair {

struct SheetDamage {
    Finds crowded;              ///< edges of three and more faces
    Finds turned;               ///< faces that are turned round
    Finds unorientable;         ///< edges that are cut, as the faces on their sides cannot be turned to fit
    std::vector<uint8_t> atCut; ///< per vertex: 1 if it ends one of the edges that were crowded or cut
};

/// Turns faces so that all that are joined fit, and returns per corner the side across its own, kNone where nothing is
/// joined.
///
/// Two faces that are alone at an edge are joined. At an edge of more faces as many pairs as fit are joined: first
/// those that run against each other as they are, then those that do once a whole piece is turned round; among these
/// the pair with the smallest bend, then the one with the lowest faces. What is joined is turned to the side that has
/// the larger area, or the lowest face if both are equal. If faces that are joined by others cannot fit, as in a
/// Moebius strip, they are not joined.
///
/// An edge of three or more faces becomes a hard crease of all its sheets, and a vertex where such edges do not run on
/// a hard one: so the sheets stay together without a gap, as they do in subdivision that knows such edges.
///
/// Beyond kMaxWeighedFaces at an edge, faces that fit are paired in their order. O(corners log corners).
[[nodiscard]] std::vector<uint32_t> joinFaces(const Cage& cage, Draft& draft, const Places& places,
                                              SheetDamage& damage);

inline constexpr size_t kMaxWeighedFaces = 32;

} // namespace supple::cage::repair
