// Numbers that change affinely with two others.
#pragma once

#include <glm/glm.hpp>

namespace supple::cpu {

struct Affine {
    double constant = 0.0;
    glm::dvec2 slope{0.0}; ///< by the first and by the second

    [[nodiscard]] double at(double first, double second) const {
        return constant + (slope.x * first + slope.y * second);
    }
};
[[nodiscard]] inline Affine operator+(const Affine& a, const Affine& b) {
    return {a.constant + b.constant, a.slope + b.slope};
}
[[nodiscard]] inline Affine operator-(const Affine& a, const Affine& b) {
    return {a.constant - b.constant, a.slope - b.slope};
}
[[nodiscard]] inline Affine operator*(double s, const Affine& a) {
    return {s * a.constant, s * a.slope};
}

inline const Affine kOne{1.0, {0.0, 0.0}}, kFirst{0.0, {1.0, 0.0}}, kSecond{0.0, {0.0, 1.0}};

} // namespace supple::cpu
