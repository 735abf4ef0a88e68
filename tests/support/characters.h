// Comparing characters, member by member: what must survive a round trip through a file.
#pragma once

#include "cage/character.h"

namespace supple::test {

/// Expects `b` to be `a` but for the name, the warnings and what tells of the file (sources, source vertices). Faces
/// may have been regrouped by material, in the order of the materials' first faces; weights may differ by rounding.
void expectSame(const cage::Character& a, const cage::Character& b);

} // namespace supple::test
