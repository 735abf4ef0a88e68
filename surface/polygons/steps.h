// The passes behind construction for the scheme polygons.
#pragma once

#include "surface/steps.h"

namespace supple::surface::polygons {

/// Adds attributes, evaluate and motion for the triangles of the tables: one lane per surface vertex.
void addSteps(ProgramBuilder& builder);

} // namespace supple::surface::polygons
