// Boxes that hold cages.
#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace supple::skinning {

struct Box {
    glm::dvec3 low{0.0}, high{0.0};
};

/// Holds nothing yet: low > high.
[[nodiscard]] inline Box emptyBox() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
}
[[nodiscard]] inline bool isEmpty(const Box& box) {
    return box.low.x > box.high.x;
}

/// Makes the box hold all that is no farther than `around` from the point, along each axis.
inline void extend(Box& box, const glm::dvec3& point, double around = 0.0) {
    box.low = glm::min(box.low, point - around);
    box.high = glm::max(box.high, point + around);
}
inline void extend(Box& box, const Box& other) {
    box.low = glm::min(box.low, other.low);
    box.high = glm::max(box.high, other.high);
}

/// The box, larger on every side.
[[nodiscard]] inline Box grownBy(const Box& box, const glm::dvec3& by) {
    return {box.low - by, box.high + by};
}
[[nodiscard]] inline Box grownBy(const Box& box, double by) {
    return grownBy(box, glm::dvec3(by));
}

/// The box of a box that a matrix has moved.
[[nodiscard]] inline Box movedBy(const glm::dmat4& matrix, const Box& box) {
    const glm::dvec3 half = 0.5 * (box.high - box.low);
    const glm::dvec3 at(matrix * glm::dvec4(0.5 * (box.low + box.high), 1.0));
    const glm::dmat3 linear(matrix);
    return grownBy(Box{at, at},
                   glm::abs(linear[0]) * half.x + glm::abs(linear[1]) * half.y + glm::abs(linear[2]) * half.z);
}

} // namespace supple::skinning
