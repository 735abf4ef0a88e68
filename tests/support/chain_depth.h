// Where a view takes samples of exact patches with chains (docs/catmull_clark.md, "Levels of detail").
#pragma once

#include "surface/patch_class.h"
#include "tests/support/lod_surface.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace supple::test {

/// The last level of an instance's chains: its finest patch with chains has no full segment shorter than 2^-level.
/// `classOf`: of a patch in device order.
inline uint32_t chainDepth(const std::vector<LodSurface::Patch>& patches, uint32_t slot,
                           const std::function<surface::PatchClass(uint32_t)>& classOf) {
    using enum surface::PatchClass;
    float finest = 1.0f;
    for (const LodSurface::Patch& patch : patches) {
        const surface::PatchClass own = classOf(patch.patch);
        if (patch.slot == slot &&
            (own == irregular || own == irregularSharp || own == loopIrregular || own == loopIrregularSharp)) {
            for (size_t pair = 0; pair < patch.levels.size(); pair += 2) {
                finest = std::max(finest, 2.0f * patch.levels[pair] + 1.0f);
            }
        }
    }
    return std::max(2u, static_cast<uint32_t>(std::ceil(std::log2(finest))));
}

/// A sample of a patch: a share of the way from its limit at `corner` to that at `rim`; elsewhere than in the last cell
/// at a vertex with a chain, all of it. Parameters, or weights of the corners.
template <class Vec>
struct ConePlace {
    Vec rim{}, corner{};
    double share = 1.0;

    /// `at` evaluates the surface.
    template <class At>
    [[nodiscard]] glm::dvec3 position(const At& at) const {
        const glm::dvec3 onRim = at(rim).position;
        return share < 1.0 ? glm::mix(at(corner).position, onRim, share) : onRim;
    }
};

} // namespace supple::test
