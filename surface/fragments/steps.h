// Evaluation by the subdivision: fragments refined and taken to the limit, in workgroup memory or level by level.
#pragma once

#include "surface/steps.h"

namespace supple::surface::fragments {

/// Adds evaluate and motion for the fragments of the tables. In the wide mapping a workgroup refines a fragment in its
/// own memory; pipelines differ in how much of it they take. In the narrow mapping, and for fragments that do not fit,
/// fragments are refined level by level through a scratch buffer, with one dispatch per kind of work.
void addSteps(ProgramBuilder& builder);

} // namespace supple::surface::fragments
