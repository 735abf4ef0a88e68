// Stencils as the device reads them. They compute the vertices of a subdivision step into the coefficient pool. Private
// to surface/.
#pragma once

#include "surface/refinement.h"
#include "surface/table_writer.h"

#include <span>

namespace supple::surface {

/// Which vertices a step of stencils reads, and where it writes.
struct StencilPlace {
    Stage stage = Stage::vertex;
    bool fromPool = false;                  ///< reads the pool, else the deformed cage
    uint32_t from = 0;                      ///< first vertex that it may read
    uint32_t to = 0;                        ///< pool index of its first vertex
    std::span<const uint32_t> numbers = {}; ///< by row: the place of its vertex behind `to`; without them its own
};

/// The kernel that reads them. `numbers`: shared::kHalfWords or kWholeWords.
[[nodiscard]] KindOfKernel stencilKernel(bool fromPool, uint32_t numbers);

/// Adds the records that shaders/subdivision/isolate.comp reads, and their construction.
void writeStencils(const Stencils& stencils, const StencilPlace& place, TableWriter& writer, Tables& tables);

} // namespace supple::surface
