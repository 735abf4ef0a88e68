// P_m as a scheme: the static tables it makes of a cage.
#pragma once

#include "base/result.h"
#include "surface/recipe.h"
#include "surface/scheme.h"

namespace supple::surface::pm {

/// See surface::Scheme. O(corners). Refuses a cage with too many edge classes with ErrorCode::limit.
[[nodiscard]] Result<Tables> build(const Recipe& recipe, const cage::Cage& cage);

} // namespace supple::surface::pm
