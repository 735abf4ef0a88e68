// The subdivision as a scheme: the static tables it makes of a cage.
#pragma once

#include "base/result.h"
#include "surface/recipe.h"
#include "surface/scheme.h"

namespace supple::surface::subdivision {

/// See surface::Scheme. Refuses a vertex with so many edges that 16 bits do not number the points of its fragment:
/// "vertex 7 has 260 faces: ...".
[[nodiscard]] Result<Tables> build(const Recipe& recipe, const cage::Cage& cage);

} // namespace supple::surface::subdivision
