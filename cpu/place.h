// Places on a surface: as a host names them, by a face of the cage, and as a scheme evaluates them.
#pragma once

#include "cpu/jet.h"

#include <cstdint>
#include <glm/glm.hpp>

namespace supple::cpu {

using surface::SurfaceJet;

/// A face of the cage and a place in it. Triangle: the weights of corners 1 and 2. Quad: u from corner 0 to corner 1, v
/// to corner 3. Faces of more sides: in the triangle of side s and the middle, the weights of corner s + 1 and of the
/// middle.
struct FacePoint {
    uint32_t face = 0, side = 0;
    double a = 0.0, b = 0.0;
};

/// A place in a piece of the surface, in the piece's own x and y, and how these change with the two numbers a and b
/// that derivatives are taken by.
struct Place {
    uint32_t piece = 0;
    uint32_t sector = 0; ///< of pieces that count their parameters sector by sector
    double x = 0.0, y = 0.0;
    glm::dvec2 xSlope{1.0, 0.0}, ySlope{0.0, 1.0}; ///< by a and b
    glm::dvec3 xBend{0.0};                         ///< twice by a, by a and b, twice by b; y has none
};

/// What a point of a face is. Where a surface has no derivatives, or in directions that hang on how the place is come
/// to, those of a place beside it are taken.
struct FoundPlace {
    const char* fault = nullptr; ///< why there is none
    Place place;
    bool held = false; ///< derivatives are those of `beside`
    Place beside;
};

/// The derivatives of a jet in x and y become those by a and b.
inline void turn(const Place& place, SurfaceJet& jet) {
    const glm::dvec2 &x = place.xSlope, &y = place.ySlope;
    const SurfaceJet own = jet;
    jet.du = x.x * own.du + y.x * own.dv;
    jet.dv = x.y * own.du + y.y * own.dv;
    const auto second = [&](double xa, double ya, double xb, double yb, double bend) {
        return xa * xb * own.duu + (xa * yb + ya * xb) * own.duv + ya * yb * own.dvv + bend * own.du;
    };
    jet.duu = second(x.x, y.x, x.x, y.x, place.xBend.x);
    jet.duv = second(x.x, y.x, x.y, y.y, place.xBend.y);
    jet.dvv = second(x.y, y.y, x.y, y.y, place.xBend.z);
}

} // namespace supple::cpu
