// From a draft to a cage: everything that faces, corners, vertices and edges carry. Private to cage/repair.
#pragma once

#include "base/result.h"
#include "cage/repair/draft.h"

namespace supple::cage::repair {

/// Makes the draft the cage. Vertices without a face are dropped; the others keep their order, copies come behind. A
/// copy has the position, influences, displacements and sharpness of its source; an edge between copies has the crease
/// and the crease scalars of the edge between their sources. Refuses more than kMaxCopiedValues influences or
/// displacements of copies. `weights` may be empty.
[[nodiscard]] Status applyDraft(const Draft& draft, Cage& cage, SkinWeights& weights, Morphs& morphs);

inline constexpr size_t kMaxCopiedValues = 1u << 26;

} // namespace supple::cage::repair
