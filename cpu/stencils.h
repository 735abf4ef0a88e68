// Stencils on the CPU, in float or double. Sums have the order that they have on the device.
#pragma once

#include "surface/refinement.h"

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::surface {

/// A row is p_first + sum of w_i (p_i - p_first), over all its entries but the first.
template <class T>
[[nodiscard]] glm::vec<3, T> applyStencil(const Stencils& stencils, uint32_t row,
                                          std::span<const glm::vec<3, T>> positions) {
    const uint32_t begin = stencils.starts[row];
    const glm::vec<3, T> first = positions[stencils.vertices[begin]];
    glm::vec<3, T> sum(T(0));
    for (uint32_t i = begin + 1; i < stencils.starts[row + 1]; ++i) {
        sum += T(stencils.weights[i]) * (positions[stencils.vertices[i]] - first);
    }
    return first + sum;
}

/// All rows.
template <class T>
[[nodiscard]] std::vector<glm::vec<3, T>> applyStencils(const Stencils& stencils,
                                                        std::span<const glm::vec<3, T>> positions) {
    std::vector<glm::vec<3, T>> points;
    points.reserve(stencils.rows());
    for (uint32_t row = 0; row < stencils.rows(); ++row) {
        points.push_back(applyStencil<T>(stencils, row, positions));
    }
    return points;
}

} // namespace supple::surface
