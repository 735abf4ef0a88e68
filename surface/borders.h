// The borders of patches as their records have them: pool indices, side by side. For the classes whose borders are
// cubics (p-rep, P_m).
#pragma once

#include "surface/scheme.h"

#include <array>
#include <vector>

namespace supple::surface {

/// End, its tangent, the other end's tangent, other end. Patches that have an edge in common have the same four, read
/// backwards; across a crease they do not.
using BorderCurve = std::array<uint32_t, 4>;

/// Elements of a patch record.
[[nodiscard]] uint32_t recordElements(const Tables& tables, PatchClass patchClass);

/// Border curves by side of the grid: a polar patch has four, one of them the apex.
[[nodiscard]] std::vector<BorderCurve> borderCurves(const uint32_t* record, PatchClass patchClass);

} // namespace supple::surface
