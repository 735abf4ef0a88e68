// The faces of a cage before it is repaired, as its repair will see them.
#pragma once

#include "cage/character.h"
#include "cage/polygons.h"

namespace supple::cage {

/// The faces of a cage as repairCage() looks at them first: simple, each once, and turned to fit their neighbors. Cuts
/// nothing. The faces of a cage without damage as they are.
[[nodiscard]] Polygons soundFaces(const Cage& cage);

} // namespace supple::cage
