// Where a P_m surface turns over on itself: coarse cages, above all fans of ten and more triangles, can make it do so.
#pragma once

#include "surface/pm/mesh.h"

#include <cstdint>
#include <vector>

namespace supple::tools {

/// Counted over the triangles of the patches' grids, in the rest pose.
struct Folds {
    struct Face {
        uint32_t face = 0; ///< of the cage as it was given
        uint32_t flipped = 0;
        uint32_t triangles = 0;
    };
    std::vector<Face> faces; ///< those with folds, the largest share first
    uint64_t flipped = 0;
    uint64_t triangles = 0; ///< of all faces
};

inline constexpr uint32_t kFoldRate = 8;

/// A patch is folded where neighboring triangles of its grid turn by more than a right angle against each other; of
/// its triangles those are flipped that face against the patch as a whole. A patch that is merely bent has none.
[[nodiscard]] Folds findFolds(const surface::pm::Mesh& mesh);

} // namespace supple::tools
