// The limit surface of Loop at any parameter, in double: quartic box splines over ever smaller triangles round a vertex
// (docs/loop.md).
#pragma once

#include "cpu/catmull_clark.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>

namespace supple::surface::loop {

using catmull_clark::Point;

/// The limit surface over the triangles of a cage.
class LimitSurface {
public:
    /// `pose`: of a mesh of Loop; must outlive this.
    explicit LimitSurface(const subdivision::LimitPose& pose) : pose_(&pose) {}
    /// The mesh must outlive it. The positions are those of the cage that it was built from.
    LimitSurface(const subdivision::Mesh& mesh, std::span<const glm::dvec3> positions)
        : own_(std::make_shared<const subdivision::PosedLimit>(mesh, positions)), pose_(&own_->pose) {}

    /// What a place of a triangle is evaluated from; a facet's level is 1.
    [[nodiscard]] static subdivision::SectorLevel levelAt(const subdivision::LimitShape& shape, uint32_t triangle,
                                                          double v, double w);
    /// The place on that net, whose level is not 0.
    [[nodiscard]] static Point on(const subdivision::LevelNet& net, const subdivision::LimitShape::Sector& sector,
                                  double v, double w);

    [[nodiscard]] uint32_t triangleCount() const { return static_cast<uint32_t>(pose_->shape().sectors().size() / 4); }

    /// Where corners 1 and 2 of a triangle have the weights v and w, and corner 0 the rest. Derivatives are those in v
    /// and w. The position is exact to rounding but within 2^-40 of a corner, where it is the corner's; there du and dv
    /// are zero, but of corners where all faces are regular. The normal is the limit's, but for a run of several faces
    /// between creases at a corner, where it is a mean.
    [[nodiscard]] Point at(uint32_t triangle, double v, double w) const;

private:
    /// (a, b): from the corner along its two edges, up to 1/2 together. Derivatives in a and b.
    [[nodiscard]] static Point atDistance(const subdivision::LevelNet& net, uint32_t sector, double a, double b);
    /// (x, y): weights of corners 1 and 2 of the facet, whose net it is. Derivatives in x and y.
    [[nodiscard]] static Point inMiddle(const subdivision::LevelNet& net, double x, double y);

    std::shared_ptr<const subdivision::PosedLimit> own_; ///< null: the pose is another one's
    const subdivision::LimitPose* pose_;
};

} // namespace supple::surface::loop
