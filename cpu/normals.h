// Normals of surfaces.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace supple::cpu {

/// Along du x dv, of unit length. Zero where the two are parallel.
template <class T>
[[nodiscard]] glm::vec<3, T> unitNormal(const glm::vec<3, T>& du, const glm::vec<3, T>& dv) {
    constexpr T kSine = T(1e-5);
    const glm::vec<3, T> normal = glm::cross(du, dv);
    const T square = glm::dot(normal, normal), lengths = glm::dot(du, du) * glm::dot(dv, dv);
    return square > kSine * kSine * lengths ? normal / std::sqrt(square) : glm::vec<3, T>(T(0));
}

} // namespace supple::cpu
