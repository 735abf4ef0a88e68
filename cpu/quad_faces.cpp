#include "cpu/quad_faces.h"

#include "cpu/affine.h"
#include "cpu/surface.h"

#include <algorithm>
#include <array>

namespace supple::cpu {
namespace {

/// A corner of a face, and the place in the quad that a step makes there.
struct AtCorner {
    uint32_t corner = 0;
    Affine u, v;
};

/// The quad has half of each edge.
AtCorner cornerOfQuad(const FacePoint& point) {
    const Affine right = kOne - kFirst, up = kOne - kSecond;
    const bool far = point.a > 0.5, high = point.b > 0.5;
    return high ? (far ? AtCorner{2, 2.0 * right, 2.0 * up} : AtCorner{3, 2.0 * up, 2.0 * kFirst})
                : (far ? AtCorner{1, 2.0 * kSecond, 2.0 * right} : AtCorner{0, 2.0 * kFirst, 2.0 * kSecond});
}

/// The corner of the largest weight; beyond it the two others' weights, halved where they are equal.
AtCorner cornerOfTriangle(const FacePoint& point) {
    const std::array<Affine, 3> weights{(kOne - kFirst) - kSecond, kFirst, kSecond};
    uint32_t corner = 0;
    for (uint32_t c = 1; c < 3; ++c) {
        corner = weights[c].at(point.a, point.b) > weights[corner].at(point.a, point.b) ? c : corner;
    }
    const Affine &next = weights[(corner + 1) % 3], &last = weights[(corner + 2) % 3];
    return next.at(point.a, point.b) >= last.at(point.a, point.b) ? AtCorner{corner, 2.0 * next + last, 3.0 * last}
                                                                  : AtCorner{corner, 3.0 * next, 2.0 * last + next};
}

/// Of a face of more sides: the triangle of a side and the middle.
AtCorner cornerOfWedge(const FacePoint& point, uint32_t sides) {
    const Affine first = (kOne - kFirst) - kSecond;
    return kFirst.at(point.a, point.b) <= first.at(point.a, point.b)
               ? AtCorner{point.side, 2.0 * kFirst + kSecond, kSecond}
               : AtCorner{(point.side + 1) % sides, kSecond, 2.0 * first + kSecond};
}

} // namespace

QuadFaces::QuadFaces(const cage::Cage& cage, bool stepped)
    : faceStarts_(cage.faceStarts), holes_(cage.faceCount(), false), stepped_(stepped) {
    for (const uint32_t face : cage.holes) {
        holes_[face] = true;
    }
}

FoundPlace QuadFaces::find(const FacePoint& point) const {
    FoundPlace found;
    if (holes_[point.face]) {
        found.fault = kHole;
        return found;
    }
    Place& place = found.place;
    if (!stepped_) {
        place.piece = point.face;
        place.x = point.a;
        place.y = point.b;
        return found;
    }
    const uint32_t sides = faceStarts_[point.face + 1] - faceStarts_[point.face];
    const AtCorner at = sides == 3   ? cornerOfTriangle(point)
                        : sides == 4 ? cornerOfQuad(point)
                                     : cornerOfWedge(point, sides);
    place.piece = faceStarts_[point.face] + at.corner;
    place.x = std::clamp(at.u.at(point.a, point.b), 0.0, 1.0);
    place.y = std::clamp(at.v.at(point.a, point.b), 0.0, 1.0);
    place.xSlope = at.u.slope;
    place.ySlope = at.v.slope;
    return found;
}

} // namespace supple::cpu
