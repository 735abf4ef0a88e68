// What searches for points go over: the faces of a cage, or their sides.
#pragma once

#include "cage/character.h"
#include "supple/supple.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace supple::runtime {

class CpuGroup;

[[nodiscard]] inline glm::dvec3 vectorAt(const float* v) {
    return {v[0], v[1], v[2]};
}

inline constexpr SuppleSurfacePoint kNoPoint{SUPPLE_NO_FACE, 0, 0.0f, 0.0f};

/// What the numbers of a surface point run over: a quad, a triangle, or the triangle of a side and the middle of a face
/// of more sides.
struct PointDomain {
    uint32_t face = 0, side = 0;
    bool isQuad = false;

    [[nodiscard]] SuppleSurfacePoint at(double a, double b) const {
        return {face, side, static_cast<float>(a), static_cast<float>(b)};
    }
    /// Back into the domain.
    [[nodiscard]] glm::dvec2 held(glm::dvec2 at) const {
        at = glm::clamp(at, 0.0, 1.0);
        if (!isQuad && at.x + at.y > 1.0) { // straight to the slant
            const double over = 0.5 * (at.x + at.y - 1.0);
            at.x = std::clamp(at.x - over, 0.0, 1.0);
            at.y = 1.0 - at.x;
        }
        return at;
    }
};
/// In the order of faces, without holes.
[[nodiscard]] std::vector<PointDomain> pointDomains(const CpuGroup& group);

/// A part of a domain: a square, or a triangle in a triangle.
struct Cell {
    glm::dvec2 origin{0.0}, x{0.0}, y{0.0};

    [[nodiscard]] double size(bool isQuad) const { return (isQuad ? 1.0 : 0.5) * std::abs(x.x * y.y - x.y * y.x); }
    [[nodiscard]] glm::dvec2 middle(bool isQuad) const { return origin + (isQuad ? 0.5 : 1.0 / 3.0) * (x + y); }
};
/// `along`: cells at a side of the domain.
[[nodiscard]] std::vector<Cell> cellsOf(bool isQuad, uint32_t along);
/// How many a domain of a face is looked at by: faces of many sides have enough domains.
[[nodiscard]] inline uint32_t cellsAlong(uint32_t sides) {
    return sides <= 8 ? 4 : sides <= 32 ? 2 : 1;
}

/// Samples of a domain stand in rows of `b`; those of a triangle become shorter.
struct SampleGrid {
    bool isQuad = false;
    uint32_t along = 0;

    [[nodiscard]] uint32_t rowLength(uint32_t row) const { return along + 1 - (isQuad ? 0 : row); }
    [[nodiscard]] uint32_t number(uint32_t i, uint32_t j) const {
        return isQuad ? j * (along + 1) + i : j * (along + 1) - j * (j - 1) / 2 + i;
    }
    [[nodiscard]] bool has(uint32_t i, uint32_t j) const { return j <= along && i < rowLength(j); }
    [[nodiscard]] glm::dvec2 at(uint32_t i, uint32_t j) const { return glm::dvec2(i, j) / static_cast<double>(along); }

    /// Calls visit(three samples, each its two numbers).
    template <class F>
    void forEachTriangle(F&& visit) const {
        for (uint32_t j = 0; j < along; ++j) {
            for (uint32_t i = 0; i + 1 < rowLength(j); ++i) {
                visit(glm::uvec2(i, j), glm::uvec2(i + 1, j), glm::uvec2(i, j + 1));
                if (has(i + 1, j + 1)) {
                    visit(glm::uvec2(i + 1, j + 1), glm::uvec2(i, j + 1), glm::uvec2(i + 1, j));
                }
            }
        }
    }
};

} // namespace supple::runtime
