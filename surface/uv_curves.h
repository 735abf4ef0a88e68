// Smooth texture coordinates along the edges of an indexed mesh: curves, made of the coefficients that the tables have
// of a patch. Private to surface/.
#pragma once

#include "surface/table_writer.h"

namespace supple::surface {

/// The first table element of a patch's smooth texture coordinates.
[[nodiscard]] uint32_t uvElement(const Tables& tables, uint32_t patch, uint32_t set);

/// Writes of every UV set the cubic along a side and that of the derivative across, each with what the perturbation
/// adds. `side`: of the patch's domain. `writer` writes the tables' words. They have no leaves (Tables::uvLeaves).
void writeUvCurves(const Tables& tables, uint32_t patch, uint32_t side, TableWriter& writer);

} // namespace supple::surface
