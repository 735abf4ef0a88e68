// Checks stencils in the tables of the exact schemes (surface/stencil_table.h). Private to chains/.
#pragma once

#include "surface/chains/check_bounds.h"

namespace supple::surface::chains {

/// Follows the rows of a construction by stencils as shaders/subdivision/isolate.comp does: the vertices and weights
/// that they name, and the coefficients that they write. `vertices`: so many there are to read, those before
/// Construction::from counted.
[[nodiscard]] bool checkStencils(TableCheck& check, const Construction& construction, uint64_t vertices);

} // namespace supple::surface::chains
