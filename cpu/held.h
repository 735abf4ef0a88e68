// Places whose derivatives are taken beside a corner.
#pragma once

#include "cpu/place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

namespace supple::cpu {

/// So far from a corner that is not regular derivatives are taken, in the parameters of a quad or a triangle.
inline constexpr double kBesideCorner = 0x1p-30;
/// The same where they come to a limit only slowly: charts, apexes, and a face alone between the two halves of a
/// crease, whose sides are parallel at their corner.
inline constexpr double kBesideSlowCorner = 1.0 / 1024.0;

/// Nearer than `distance` to a corner, the derivatives are those on the ray from the corner through the place; at the
/// corner itself, on that to the middle. All three in the parameters of the place.
inline void holdOff(FoundPlace& found, const glm::dvec2& corner, const glm::dvec2& middle, double distance) {
    const auto length = [](const glm::dvec2& v) { return std::max(std::abs(v.x), std::abs(v.y)); };
    glm::dvec2 ray = glm::dvec2(found.place.x, found.place.y) - corner;
    if (length(ray) >= distance) {
        return;
    }
    if (length(ray) == 0.0) {
        ray = middle - corner;
    }
    const glm::dvec2 beside = corner + (distance / length(ray)) * ray;
    found.held = true;
    found.beside = found.place;
    found.beside.x = beside.x;
    found.beside.y = beside.y;
}

inline constexpr std::array<glm::dvec2, 4> kQuadCorners{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}};
inline constexpr glm::dvec2 kQuadMiddle{0.5, 0.5};
/// By the weights of corners 1 and 2.
inline constexpr std::array<glm::dvec2, 3> kTriangleCorners{{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}};
inline constexpr glm::dvec2 kTriangleMiddle{1.0 / 3.0, 1.0 / 3.0};

/// The corner of a quad that a place is nearest to.
[[nodiscard]] inline uint32_t nearestQuadCorner(const Place& place) {
    return place.y > 0.5 ? (place.x > 0.5 ? 2 : 3) : (place.x > 0.5 ? 1 : 0);
}

} // namespace supple::cpu
