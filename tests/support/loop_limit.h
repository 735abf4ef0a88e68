// The Loop limit surface of triangles by OpenSubdiv's Bfr, in double. Only where OpenSubdiv is installed.
#pragma once

#include "tests/support/catmull_clark_limit.h"

namespace supple::test {

/// Creases, sharp vertices and holes as the cage has them, boundaries with sharp corners.
class LoopLimit {
public:
    using Point = CatmullClarkLimit::Point;

    /// All faces must be triangles.
    LoopLimit(const cage::Cage& cage, const std::vector<glm::dvec3>& positions);
    ~LoopLimit();
    LoopLimit(const LoopLimit&) = delete;
    LoopLimit& operator=(const LoopLimit&) = delete;

    /// Where corners 1 and 2 have the weights v and w. Holes have no points.
    [[nodiscard]] Point at(uint32_t face, double v, double w) const;

private:
    struct Surfaces;
    std::unique_ptr<Surfaces> surfaces_;
};

} // namespace supple::test
