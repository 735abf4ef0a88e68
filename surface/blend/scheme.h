// The blending surface as a scheme: the static tables it makes of a cage.
#pragma once

#include "base/result.h"
#include "surface/recipe.h"
#include "surface/scheme.h"

namespace supple::surface::blend {

/// See surface::Scheme. O(corners + classes rate^2).
[[nodiscard]] Result<Tables> build(const Recipe& recipe, const cage::Cage& cage);
[[nodiscard]] float boundsMargin(const cage::Cage& cage);

} // namespace supple::surface::blend
