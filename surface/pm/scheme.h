// P_m as a scheme: the static tables it makes of a cage.
#pragma once

#include "surface/pm/mesh.h"
#include "surface/scheme.h"

namespace supple::surface::pm {

/// The tables of shaders/shared/{surface,pm}.h. O(corners).
[[nodiscard]] Tables buildTables(const Mesh& mesh);

} // namespace supple::surface::pm
