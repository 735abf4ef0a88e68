#include "cpu/cut_faces.h"

#include "cpu/held.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace supple::cpu {
namespace {

/// A triangle of the face's plane, and the parameters that its corners have in a piece.
struct PlaneTriangle {
    uint32_t sector = 0;
    std::array<glm::dvec2, 3> corners;
    std::array<glm::dvec2, 3> parameters;
};

/// A point of the plane, and how it changes with a and b.
struct PlanePoint {
    glm::dvec2 at{0.0}, byA{1.0, 0.0}, byB{0.0, 1.0};
};

double crossOf(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

glm::dvec2 cornerInPlane(uint32_t sides, uint32_t corner) {
    if (sides <= 4) {
        return sides == 3 ? kTriangleCorners[corner] : kQuadCorners[corner];
    }
    const double angle = 2.0 * std::numbers::pi * (corner % sides) / sides;
    return {std::cos(angle), std::sin(angle)};
}

/// If there are more than four sides, the middle is the origin.
PlanePoint pointInPlane(uint32_t sides, const FacePoint& point) {
    if (sides <= 4) {
        return {{point.a, point.b}};
    }
    const glm::dvec2 first = cornerInPlane(sides, point.side), second = cornerInPlane(sides, point.side + 1);
    PlanePoint out{{}, second - first, -first};
    out.at = first + point.a * out.byA + point.b * out.byB;
    return out;
}

/// Calls visit(triangle) for those that a part is made of: quads by their diagonal 0-2, pentagons by their sectors.
template <class Visit>
void forEachTriangle(std::span<const glm::dvec2> corners, Visit&& visit) {
    if (corners.size() == 3) {
        visit(PlaneTriangle{0, {corners[0], corners[1], corners[2]}, kTriangleCorners});
    } else if (corners.size() == 4) {
        for (size_t k = 1; k < 3; ++k) {
            visit(PlaneTriangle{
                0, {corners[0], corners[k], corners[k + 1]}, {kQuadCorners[0], kQuadCorners[k], kQuadCorners[k + 1]}});
        }
    } else {
        glm::dvec2 middle(0.0);
        for (const glm::dvec2& corner : corners) {
            middle += corner / static_cast<double>(corners.size());
        }
        for (size_t s = 0; s < corners.size(); ++s) {
            visit(PlaneTriangle{
                static_cast<uint32_t>(s), {corners[s], corners[(s + 1) % corners.size()], middle}, kTriangleCorners});
        }
    }
}

/// The weights of corners 1 and 2.
glm::dvec2 weightsIn(const PlaneTriangle& triangle, const glm::dvec2& offset) {
    const glm::dvec2 one = triangle.corners[1] - triangle.corners[0], two = triangle.corners[2] - triangle.corners[0];
    const double area = crossOf(one, two);
    return {crossOf(offset, two) / area, crossOf(one, offset) / area};
}

void put(const PlaneTriangle& triangle, const PlanePoint& point, Place& place) {
    glm::dvec2 weights = glm::max(weightsIn(triangle, point.at - triangle.corners[0]), glm::dvec2(0.0));
    weights /= std::max(weights.x + weights.y, 1.0); // rounding leads out of no triangle
    const glm::dvec2 byA = weightsIn(triangle, point.byA), byB = weightsIn(triangle, point.byB);
    const glm::dvec2 one = triangle.parameters[1] - triangle.parameters[0],
                     two = triangle.parameters[2] - triangle.parameters[0];
    const glm::dvec2 at = triangle.parameters[0] + weights.x * one + weights.y * two;
    place.sector = triangle.sector;
    place.x = at.x;
    place.y = at.y;
    place.xSlope = {byA.x * one.x + byA.y * two.x, byB.x * one.x + byB.y * two.x};
    place.ySlope = {byA.x * one.y + byA.y * two.y, byB.x * one.y + byB.y * two.y};
}

} // namespace

void CutFaces::add(const cage::Cage& cage, uint32_t face, uint32_t piece, std::span<const uint32_t> vertices) {
    parts_[face].push_back(
        {piece, cage.sides(face), static_cast<uint32_t>(corners_.size()), static_cast<uint32_t>(vertices.size())});
    const auto first = cage.faceVertices.begin() + cage.faceStarts[face],
               end = cage.faceVertices.begin() + cage.faceStarts[face + 1];
    for (const uint32_t vertex : vertices) {
        corners_.push_back(static_cast<uint32_t>(std::find(first, end, vertex) - first));
    }
}

Place CutFaces::find(const FacePoint& point) const {
    Place place;
    double best = -std::numeric_limits<double>::infinity(); // how far inside
    for (const Part& part : parts_[point.face]) {
        const PlanePoint at = pointInPlane(part.sides, point);
        std::array<glm::dvec2, 5> corners;
        for (uint32_t k = 0; k < part.cornerCount; ++k) {
            corners[k] = cornerInPlane(part.sides, corners_[part.first + k]);
        }
        forEachTriangle(std::span(corners).first(part.cornerCount), [&](const PlaneTriangle& triangle) {
            const glm::dvec2 weights = weightsIn(triangle, at.at - triangle.corners[0]);
            if (const double inside = std::min({weights.x, weights.y, 1.0 - weights.x - weights.y}); inside > best) {
                best = inside;
                place.piece = part.piece;
                put(triangle, at, place);
            }
        });
    }
    return place;
}

} // namespace supple::cpu
