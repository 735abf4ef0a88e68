// Inner vertices of valence 2, which no scheme has a rule for. Private to cage/repair.
#pragma once

#include "cage/repair/draft.h"
#include "cage/repair/found.h"

namespace supple::cage::repair {

struct FoldDamage {
    Finds folds;               ///< inner vertices of two faces
    PerPart<size_t> dissolved; ///< faces merged, or sides that run past
    PerPart<size_t> kept;      ///< faces cut by an edge to a vertex
    PerPart<size_t> cutOpen;   ///< vertices repeated
};

/// Takes away the inner vertices that have two faces only:
///  - if the vertex bends the edge through it by more than kMostBend, it shapes the surface and stays. The
///    face of more corners is then cut by an edge to the vertex;
///  - else, if these faces make a triangle or a quad together, and no vertex becomes another fold, they are merged;
///  - else the vertex leaves both faces, whose common side then runs past it, if that is a new edge;
///  - else they are merged if what comes out is a simple face;
///  - else a face is cut by an edge to the vertex, if one has four corners;
///  - else they are cut apart at the vertex, which gets a copy.
/// Faces are only merged if they have the same part, material, trim tile and visibility and no crease between them. A
/// side that runs past takes the sharpest crease of its parts, if all have one; a sharp vertex is cut apart.
///
/// `draft` has no other damage; `twins` joins its sides. O(corners log corners), up to kMaxFoldRounds times.
void dissolveFolds(const Cage& cage, Draft& draft, std::vector<uint32_t> twins, const Places& places,
                   FoldDamage& damage);

/// How far a vertex may be from the line between its two neighbors, in parts of that line's length.
inline constexpr float kMostBend = 0.2f;

/// Merging faces may leave their neighbors with two faces, and so on: after so many rounds these are cut apart.
inline constexpr int kMaxFoldRounds = 16;

} // namespace supple::cage::repair
