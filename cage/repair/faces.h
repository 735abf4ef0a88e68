// Faces on their own: those that are empty, that pass a vertex twice, or that are there twice. Private to cage/repair.
#pragma once

#include "cage/repair/draft.h"
#include "cage/repair/found.h"

namespace supple::cage::repair {

struct FaceDamage {
    Finds empty;      ///< no three different vertices in a simple loop
    Finds repeating;  ///< pass a vertex twice, and are not empty
    Finds ringed;     ///< go round holes
    Finds duplicated; ///< have the corners of an earlier face, in either direction
};

/// The faces of a cage. Those that go round holes are cut into quads and triangles, others that pass a vertex twice into
/// simple loops there; empty ones are left out.
[[nodiscard]] Draft simpleFaces(const Cage& cage, const Places& places, FaceDamage& damage);

/// Of faces that run through the same vertices in the same order, in either direction, the first is kept.
/// O(corners log faces).
[[nodiscard]] Draft withoutDuplicates(Draft draft, const Places& places, FaceDamage& damage);

} // namespace supple::cage::repair
