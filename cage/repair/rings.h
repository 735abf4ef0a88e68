// Faces that go round a hole: along their outer boundary, over a bridge, round the hole and back over the bridge.
// Private to cage/repair.
#pragma once

#include "cage/repair/draft.h"

namespace supple::cage::repair {

/// Adds a face that goes round holes, as quads and triangles between its boundaries. The bridges become edges. Returns
/// false, and adds nothing, if it is no such face, or none that can be cut so: its holes must lie inside it.
[[nodiscard]] bool addRing(const Cage& cage, uint32_t face, Draft& draft);

} // namespace supple::cage::repair
