// P_m as a scheme: the static tables it makes of a cage.
#pragma once

#include "surface/pm/mesh.h"
#include "surface/scheme.h"

namespace supple::surface::pm {

/// The tables of shaders/shared/{surface,pm}.h. O(corners). Refuses cages whose edges are of too many kinds (valences
/// of the ends, sides of the face) with ErrorCode::limit.
[[nodiscard]] Result<Tables> buildTables(const Mesh& mesh);

} // namespace supple::surface::pm
