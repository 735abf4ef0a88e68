// The subdivision kernel as a scheme: the static tables it makes of a cage.
#pragma once

#include "base/result.h"
#include "surface/kernel/mesh.h"
#include "surface/scheme.h"

namespace supple::surface::kernel {

/// The tables of shaders/shared/{surface,kernel}.h for `depth` steps from the cage, at least the isolation steps.
/// Refuses a vertex of so many edges that its fragment has more points than 16-bit indices: "vertex 7 has 260 faces:
/// ...".
[[nodiscard]] Result<Tables> buildTables(const Mesh& mesh, uint32_t depth);

} // namespace supple::surface::kernel
