// The passes that choose the levels of a view's patches: levels of edges, levels of patches, places. Between the last
// two the view's budget is solved (Programs::prepareSolver).
#pragma once

#include "surface/steps.h"

namespace supple::surface::lod {

/// Adds them, and sets Program::scratchStride, which the steps of both levels use.
void addSteps(ProgramBuilder& builder);

} // namespace supple::surface::lod
