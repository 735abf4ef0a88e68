// Stencils as the device reads them: the vertices of a subdivided cage, into the front of the coefficient pool. Private
// to surface/.
#pragma once

#include "surface/subdivision.h"
#include "surface/table_writer.h"

namespace supple::surface {

/// Adds the records of kernel/isolate.comp and its construction: row i becomes pool element i.
void writeStencils(const Stencils& stencils, TableWriter& writer, Tables& tables);

} // namespace supple::surface
