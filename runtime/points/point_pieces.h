// What searches for points go over: the faces of a cage, or their sides.
#pragma once

#include "cage/character.h"
#include "supple/supple.h"

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace supple::runtime {

class CpuGroup;

/// A quad, a triangle, or of a face of more sides the triangle of a side and the middle.
struct Piece {
    uint32_t face = 0, side = 0;
    bool isQuad = false;

    [[nodiscard]] SuppleSurfacePoint at(double a, double b) const {
        return {face, side, static_cast<float>(a), static_cast<float>(b)};
    }
};
/// In the order of faces, without holes.
[[nodiscard]] std::vector<Piece> piecesOf(const CpuGroup& group);

/// A part of a piece: a square, or a triangle in a triangle.
struct Cell {
    glm::dvec2 origin{0.0}, x{0.0}, y{0.0};

    [[nodiscard]] double size(bool isQuad) const { return (isQuad ? 1.0 : 0.5) * std::abs(x.x * y.y - x.y * y.x); }
    [[nodiscard]] glm::dvec2 middle(bool isQuad) const { return origin + (isQuad ? 0.5 : 1.0 / 3.0) * (x + y); }
};
/// `along`: cells at a side of the piece.
[[nodiscard]] std::vector<Cell> cellsOf(bool isQuad, uint32_t along);
/// How many a piece of a face is looked at by: faces of many sides have enough pieces.
[[nodiscard]] inline uint32_t cellsAlong(uint32_t sides) {
    return sides <= 8 ? 4 : sides <= 32 ? 2 : 1;
}

} // namespace supple::runtime
