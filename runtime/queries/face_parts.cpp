#include "runtime/queries/face_parts.h"

namespace supple::runtime {
namespace {

using Parts = std::vector<FacePart>;

Parts triangles(uint32_t face, const std::vector<std::array<glm::dvec2, 3>>& corners) {
    Parts parts;
    for (const auto& [a, b, c] : corners) {
        parts.push_back(FacePart::triangle(face, 0, a, b, c));
    }
    return parts;
}

/// Whole, P_m's sectors, quarters, and along either diagonal.
std::vector<Parts> waysToCutQuad(uint32_t face) {
    const std::array<glm::dvec2, 4> c{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    const glm::dvec2 middle(0.5);
    const FacePart whole = FacePart::square(face, {0, c[0], c[1], c[2]}, {0, c[0], c[3], c[2]});
    const std::array<FacePart, 4> quarters = whole.quarters();
    return {{whole},
            triangles(face, {{c[0], c[1], middle}, {c[1], c[2], middle}, {c[2], c[3], middle}, {c[3], c[0], middle}}),
            Parts(quarters.begin(), quarters.end()),
            triangles(face, {{c[0], c[1], c[2]}, {c[0], c[2], c[3]}}),
            triangles(face, {{c[1], c[2], c[3]}, {c[1], c[3], c[0]}})};
}

/// Whole, P_m's sectors, and a quad at each corner.
std::vector<Parts> waysToCutTriangle(uint32_t face) {
    const std::array<glm::dvec2, 3> c{{{0, 0}, {1, 0}, {0, 1}}};
    const glm::dvec2 middle(1.0 / 3.0);
    Parts quads;
    for (size_t k = 0; k < 3; ++k) {
        const glm::dvec2 next = 0.5 * (c[(k + 1) % 3] - c[k]), last = 0.5 * (c[(k + 2) % 3] - c[k]);
        quads.push_back(FacePart::square(face, {0, c[k], next, middle - c[k]}, {0, c[k], last, middle - c[k]}));
    }
    return {triangles(face, {{c[0], c[1], c[2]}}),
            triangles(face, {{c[0], c[1], middle}, {c[1], c[2], middle}, {c[2], c[0], middle}}), quads};
}

/// A triangle at each side, and a quad at each corner.
std::vector<Parts> waysToCutPolygon(uint32_t face, uint32_t sides) {
    Parts wedges, quads;
    for (uint32_t side = 0; side < sides; ++side) {
        wedges.push_back(FacePart::triangle(face, side, {0, 0}, {1, 0}, {0, 1}));
        quads.push_back(FacePart::square(face, {side, {0, 0}, {0.5, 0}, {0, 1}},
                                         {(side + sides - 1) % sides, {1, 0}, {-0.5, 0}, {-1, 1}}));
    }
    return {wedges, quads};
}

} // namespace

std::vector<Parts> waysToCut(uint32_t face, uint32_t sides) {
    return sides == 4 ? waysToCutQuad(face) : sides == 3 ? waysToCutTriangle(face) : waysToCutPolygon(face, sides);
}

} // namespace supple::runtime
