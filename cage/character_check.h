// What every reader of this folder makes sure of, and everyone above relies on without looking.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "cage/piece.h"

namespace supple::cage {

/// Refuses a character with which somebody could read beyond an array, divide by zero or never end: for those that come
/// from a cooked file, which may be anybody's. It does not look at what is merely wrong, such as a cage that is no
/// manifold: whoever builds tables of it refuses that. All faults at once, a line each, with the name in front.
/// O(size), allocates little.
[[nodiscard]] Status checkCharacter(const Character& character);

/// The same of a piece of its cage.
[[nodiscard]] Status checkPiece(const Character& character, const CagePiece& piece);

} // namespace supple::cage
