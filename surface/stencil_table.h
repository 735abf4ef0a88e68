// Stencils as the device reads them: the vertices of a step of subdivision, into the coefficient pool. Private to
// surface/.
#pragma once

#include "surface/subdivision.h"
#include "surface/table_writer.h"

namespace supple::surface {

/// Which vertices stencils read and where their own go.
struct StencilPlace {
    Stage stage = Stage::vertex;
    Kernel kernel = Kernel::isolate; ///< or isolateFromPool
    uint32_t from = 0;               ///< first vertex: of the cage, or in the pool
    uint32_t to = 0;                 ///< in the pool
};

/// Adds the records of kernel/isolate.comp and their construction.
void writeStencils(const Stencils& stencils, const StencilPlace& place, TableWriter& writer, Tables& tables);

} // namespace supple::surface
