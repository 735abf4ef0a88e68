// Checks what level of detail adds to tables (surface/table_check.h).
#pragma once

#include "surface/table_check.h"

namespace supple::surface::lod {

/// LodTables, and the records of edges and patches. The record of a patch that an edge names is one of a class that has
/// such edges. The lanes that make each depth of chains are those of the constructions of Stage::deepen. Needs what
/// surface::checkMembers() has found.
void checkLevels(TableCheck& check);

} // namespace supple::surface::lod
