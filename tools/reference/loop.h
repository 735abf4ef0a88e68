// The limit surface of Loop at any parameter, in double: quartic box splines over ever smaller triangles round a vertex
// (docs/loop.md). For tests, comparisons and queries.
#pragma once

#include "surface/subdivision/mesh.h"
#include "surface/subdivision/pattern.h"
#include "tools/reference/catmull_clark.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <vector>

namespace supple::surface::loop {

using catmull_clark::Point;

/// The limit surface over the triangles of a cage.
class LimitSurface {
public:
    /// `mesh`: of Loop; must outlive this. `positions`: of the cage it was built from.
    LimitSurface(const subdivision::Mesh& mesh, std::span<const glm::dvec3> positions);

    [[nodiscard]] uint32_t triangleCount() const { return static_cast<uint32_t>(sectors_.size() / 4); }

    /// Where corners 1 and 2 of a triangle have the weights v and w, and corner 0 the rest. Derivatives are those in v
    /// and w. The position is exact to rounding but within 2^-40 of a corner, where it is the corner's; there du and dv
    /// are zero. The normal is the limit's, but for a run of several faces between creases at a corner, where it is a
    /// mean.
    [[nodiscard]] Point at(uint32_t triangle, double v, double w) const;

private:
    /// One of a triangle's four children: the sector of a fragment, or a facet.
    struct Sector {
        uint32_t fragment = 0, number = 0;
    };
    /// (a, b): from the corner along its two edges, up to 1/2 together. Derivatives in a and b.
    [[nodiscard]] Point atDistance(const Sector& sector, double a, double b) const;
    /// (x, y): weights of corners 1 and 2 of the facet. Derivatives in x and y.
    [[nodiscard]] Point inMiddle(const Sector& facet, double x, double y) const;

    const subdivision::Mesh& mesh_;
    std::vector<glm::dvec3> isolated_;                          ///< points of the level at which leaves begin
    std::map<subdivision::Fan, subdivision::Pattern> patterns_; ///< of a step from radius 2 to radius 3
    std::vector<Sector> sectors_;                               ///< four per triangle: of its corners, and the middle
};

} // namespace supple::surface::loop
