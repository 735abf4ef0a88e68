#include "skinning/skinned_bounds.h"

#include "skinning/centers.h"
#include "skinning/chord.h"
#include "skinning/delta_mush.h"

#include <algorithm>

namespace supple::skinning {

/// About a center c, a vertex u is at sum_j w_j M_j c + R sum_j w_j U_j (u - c), where M_j = R_j U_j; linearly skinned
/// at sum_j w_j M_j u. They are sum_j w_j (R - R_j) U_j (u - c) apart: no farther than twice the largest |M_j| |u - c|.
///
/// Delta mush has a mean of linearly skinned vertices without morph targets, which the box holds, but for what the arms
/// account for (DeltaMush), and adds R sum_j w_j U_j (u - p): no longer than the largest |M_j| |u - p|.
SkinnedBounds::SkinnedBounds(const Skinning& skinning) : mode_(skinning.mode) {
    switch (skinningRow(mode_).extra) {
    case SkinExtra::none:
        break;
    case SkinExtra::centers:
        arms_ = skinning.centers->arms;
        share_ = 2.0;
        break;
    case SkinExtra::mush:
        arms_ = skinning.mush->arms;
        share_ = 1.0;
        break;
    }
}

template <class F>
Box SkinnedBounds::grown(const Reach& reach, const Box& linear, double morphed, F&& sizeOf) const {
    if (mode_ == SkinningMode::dualQuaternion) {
        return dualQuaternionBounds(reach, linear);
    }
    double farthest = 0.0;
    for (size_t joint = 0; joint < arms_.size(); ++joint) {
        if (arms_[joint] > 0.0) {
            farthest = std::max(farthest, sizeOf(joint) * (arms_[joint] + morphed));
        }
    }
    return grownBy(linear, share_ * farthest);
}

Box SkinnedBounds::reached(const Reach& reach, const Box& linear) const {
    return grown(reach, linear, reach.morphed, [&](size_t joint) { return reach.sizes[joint]; });
}

Box SkinnedBounds::posed(const Reach& reach, std::span<const Affine> palette,
                         std::span<const float> morphWeights) const {
    const Box linear = paletteBounds(reach, palette, morphWeights);
    return grown(reach, linear, reachedBy(morphWeights, reach.deltas), [&](size_t joint) {
        glm::dmat3 matrix;
        for (int row = 0; row < 3; ++row) {
            matrix[row] = glm::dvec3(glm::dvec4(palette[joint].rows[row])); // transposed: of the same norm
        }
        return normOf(matrix);
    });
}

} // namespace supple::skinning
