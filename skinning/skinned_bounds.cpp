#include "skinning/skinned_bounds.h"

#include "skinning/chord.h"

#include <algorithm>

namespace supple::skinning {

/// About a center c, a vertex u is at sum_j w_j M_j c + R sum_j w_j U_j (u - c), where M_j = R_j U_j; linearly skinned
/// at sum_j w_j M_j u. They are sum_j w_j (R - R_j) U_j (u - c) apart: no farther than twice the largest |M_j| |u - c|.
template <class F>
Box SkinnedBounds::grown(const Reach& reach, const Box& linear, F&& sizeOf) const {
    switch (mode_) {
    case SkinningMode::linear:
        return linear;
    case SkinningMode::dualQuaternion:
        return dualQuaternionBounds(reach, linear);
    case SkinningMode::centersOfRotation:
        break;
    }
    double farthest = 0.0;
    for (size_t joint = 0; joint < centers_->arms.size(); ++joint) {
        if (centers_->arms[joint] > 0.0) {
            farthest = std::max(farthest, sizeOf(joint) * centers_->arms[joint]);
        }
    }
    return grownBy(linear, 2.0 * farthest);
}

Box SkinnedBounds::reached(const Reach& reach, const Box& linear) const {
    return grown(reach, linear, [&](size_t joint) { return reach.sizes[joint]; });
}

Box SkinnedBounds::posed(const Reach& reach, std::span<const Affine> palette, const Box& linear) const {
    return grown(reach, linear, [&](size_t joint) {
        glm::dmat3 matrix;
        for (int row = 0; row < 3; ++row) {
            matrix[row] = glm::dvec3(glm::dvec4(palette[joint].rows[row])); // transposed: of the same norm
        }
        return normOf(matrix);
    });
}

} // namespace supple::skinning
