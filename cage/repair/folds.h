// Inner vertices of valence 2, which no scheme has a rule for. Private to cage/repair.
#pragma once

#include "cage/repair/draft.h"

namespace supple::cage::repair {

struct FoldDamage {
    Found folds;        ///< inner vertices of two faces
    size_t cutOpen = 0; ///< vertices among them that were neither merged away nor dissolved
};

/// Takes away the inner vertices that have two faces only:
///  - if these faces make a triangle or a quad together, and no vertex becomes another fold, they are merged;
///  - else the vertex leaves both faces, whose common side then runs past it, if that is a new edge;
///  - else they are merged if what comes out is a simple face;
///  - else they are cut apart at the vertex, which gets a copy.
/// Faces are only merged if they have the same material, trim tile and visibility and no crease between them. A side
/// that runs past takes the sharpest crease of its parts, if all have one; a sharp vertex is cut apart.
///
/// `draft` has no other damage; `twins` joins its sides. O(corners log corners), up to kMaxFoldRounds times.
void dissolveFolds(const Cage& cage, Draft& draft, std::vector<uint32_t> twins, FoldDamage& damage);

/// Merging faces may leave their neighbours with two faces, and so on: after so many rounds these are cut apart.
inline constexpr int kMaxFoldRounds = 16;

} // namespace supple::cage::repair
