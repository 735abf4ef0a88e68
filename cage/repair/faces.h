// Faces on their own: those that are empty, that pass a vertex twice, or that are there twice. Private to cage/repair.
#pragma once

#include "cage/repair/draft.h"

namespace supple::cage::repair {

struct FaceDamage {
    Found empty;      ///< no three different vertices in a simple loop
    Found repeating;  ///< pass a vertex twice, and are not empty
    Found duplicated; ///< have the corners of an earlier face, in either direction
};

/// The faces of a cage. Those that pass a vertex twice are cut into simple loops there; empty ones are left out.
[[nodiscard]] Draft simpleFaces(const Cage& cage, FaceDamage& damage);

/// Of faces that run through the same vertices in the same order, in either direction, the first is kept.
/// O(corners log faces).
[[nodiscard]] Draft withoutDuplicates(Draft draft, FaceDamage& damage);

} // namespace supple::cage::repair
