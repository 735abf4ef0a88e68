// The Catmull-Clark limit surface of a cage by OpenSubdiv's Bfr, in double. Only where OpenSubdiv is installed.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

namespace supple::test {

/// Creases, sharp vertices and holes as the cage has them, boundaries with sharp corners. A quad is one part with its
/// corners at (0,0) (1,0) (1,1) (0,1); another face has a part at each corner, the quad between the corner, the middles
/// of its two edges and the middle of the face in that sense.
class CatmullClarkLimit {
public:
    CatmullClarkLimit(const cage::Cage& cage, const std::vector<glm::dvec3>& positions);
    ~CatmullClarkLimit();
    CatmullClarkLimit(const CatmullClarkLimit&) = delete;
    CatmullClarkLimit& operator=(const CatmullClarkLimit&) = delete;

    struct Point {
        glm::dvec3 position, du, dv;
        [[nodiscard]] glm::dvec3 normal() const { return glm::cross(du, dv); }
    };
    /// Holes have no points.
    [[nodiscard]] Point at(uint32_t face, uint32_t part, double u, double v) const;

    /// The point nearest to p on a face and those round its vertices, by Gauss-Newton from the best of a grid of
    /// points.
    [[nodiscard]] Point nearest(uint32_t face, const glm::dvec3& p) const;

private:
    struct Part {
        uint32_t face = 0, part = 0;
        std::vector<glm::dvec3> grid; ///< (kGrid + 1)^2 points, u fastest
    };
    [[nodiscard]] Point nearestFrom(const Part& part, double u, double v, const glm::dvec3& p) const;

    struct Surfaces;
    std::unique_ptr<Surfaces> surfaces_;
    std::vector<Part> parts_;
    std::vector<std::vector<uint32_t>> near_; ///< per face: parts of it and of the faces round it
};

} // namespace supple::test
