// Parts of a cage's faces, as queries cut them.
#pragma once

#include "supple/supple.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace supple::runtime {

/// A part of a face with parameters of its own: a square, or a triangle (u, v >= 0, u + v <= 1). Where it lies on the
/// face is linear on either side of u = v: so it has the squares that a step of Catmull-Clark makes at the corners of a
/// face, whose halves may lie beside two sides of it.
struct FacePart {
    /// Numbers of the face at (0, 0), and what they gain to (1, 0) or (0, 1), and to (1, 1).
    struct Half {
        uint32_t side = 0;
        glm::dvec2 at{0.0}, gain{0.0}, diagonal{0.0};
    };
    uint32_t face = 0;
    bool isSquare = true;
    Half first, second;     ///< where u >= v, and where u < v. A triangle takes the gains of both
    glm::dvec2 corner{0.0}; ///< of squares: what is left of the halves' square
    double size = 1.0;

    [[nodiscard]] static FacePart square(uint32_t face, const Half& first, const Half& second) {
        FacePart part;
        part.face = face;
        part.first = first;
        part.second = second;
        return part;
    }
    [[nodiscard]] static FacePart triangle(uint32_t face, uint32_t side, const glm::dvec2& a, const glm::dvec2& b,
                                           const glm::dvec2& c) {
        FacePart part;
        part.face = face;
        part.isSquare = false;
        part.first = {side, a, b - a, {}};
        part.second = {side, a, c - a, {}};
        return part;
    }
    [[nodiscard]] SuppleSurfacePoint at(const glm::dvec2& own) const {
        const glm::dvec2 p = corner + size * own;
        const bool isFirst = !isSquare || p.x >= p.y;
        const Half& half = isFirst ? first : second;
        const glm::dvec2 on = !isSquare ? first.at + p.x * first.gain + p.y * second.gain
                              : isFirst ? first.at + (p.x - p.y) * first.gain + p.y * first.diagonal
                                        : second.at + (p.y - p.x) * second.gain + p.x * second.diagonal;
        const glm::dvec2 held = glm::clamp(on, 0.0, 1.0);
        return {face, half.side, static_cast<float>(held.x), static_cast<float>(held.y)};
    }
    /// Its four halves by length.
    [[nodiscard]] std::array<FacePart, 4> quarters() const {
        std::array<FacePart, 4> parts{*this, *this, *this, *this};
        if (isSquare) {
            for (uint32_t k = 0; k < 4; ++k) {
                parts[k].size = 0.5 * size;
                parts[k].corner = corner + 0.5 * size * glm::dvec2(k % 2, k / 2);
            }
            return parts;
        }
        const glm::dvec2 a = first.at, b = a + first.gain, c = a + second.gain, ab = 0.5 * (a + b), bc = 0.5 * (b + c),
                         ca = 0.5 * (c + a);
        const uint32_t side = first.side;
        return {triangle(face, side, a, ab, ca), triangle(face, side, ab, b, bc), triangle(face, side, ca, bc, c),
                triangle(face, side, bc, ca, ab)};
    }
};

/// Ways to cut a face, the likely first: as a whole, and along what schemes cut faces by.
[[nodiscard]] std::vector<std::vector<FacePart>> waysToCut(uint32_t face, uint32_t sides);

} // namespace supple::runtime
