// The limit surface of Catmull-Clark at any parameter, in double: bicubic B-spline leaves of ever smaller quads round a
// vertex, where creases are weights (docs/catmull_clark.md).
#pragma once

#include "cpu/jet.h"
#include "cpu/limit_nets.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>

namespace supple::surface::catmull_clark {

/// A point of the surface. The derivatives are those in the quad's own parameters; their cross product points outwards.
struct Point {
    glm::dvec3 position{0.0};
    glm::dvec3 du{0.0}, dv{0.0};
    glm::dvec3 normal{0.0}; ///< of unit length, or zero if there is none
    glm::dvec3 duu{0.0}, duv{0.0}, dvv{0.0};

    [[nodiscard]] SurfaceJet jet() const { return {position, du, dv, duu, duv, dvv}; }
};

/// Second derivatives in other parameters: each of `u` and `v` has the slopes of the point's own two in it.
void turnSecondDerivatives(const glm::dvec2& u, const glm::dvec2& v, Point& point);

/// The limit at the centre of a vertex fragment, with the normal of a sector.
[[nodiscard]] Point limitAtCentre(const subdivision::LimitPose& pose, const subdivision::LimitShape::Sector& sector);

/// The limit surface over the quads of a cage, or of the cage after one step if not all of its faces are quads: then
/// face f gives one quad per corner, in the order of the corners (surface::refine()).
class LimitSurface {
public:
    /// `pose`: of a mesh of Catmull-Clark; must outlive this.
    explicit LimitSurface(const subdivision::LimitPose& pose) : pose_(&pose) {}
    /// The mesh must outlive it. The positions are those of the cage that it was built from.
    LimitSurface(const subdivision::Mesh& mesh, std::span<const glm::dvec3> positions)
        : own_(std::make_shared<const subdivision::PosedLimit>(mesh, positions)), pose_(&own_->pose) {}

    /// What a place of a quad is evaluated from.
    [[nodiscard]] static subdivision::SectorLevel levelAt(const subdivision::LimitShape& shape, uint32_t quad, double u,
                                                          double v);
    /// The place on that net, whose level is not 0.
    [[nodiscard]] static Point on(const subdivision::LevelNet& net, const subdivision::LimitShape::Sector& sector,
                                  double u, double v);

    [[nodiscard]] uint32_t quadCount() const { return static_cast<uint32_t>(pose_->shape().sectors().size() / 4); }

    /// At (u, v) of a quad, both from 0 to 1, u from corner 0 to corner 1. The position is exact to rounding but within
    /// 2^-40 of a corner, where it is the corner's. There all derivatives are zero, but of corners where all faces are
    /// regular. The normal is the limit's, but for a run of several faces between creases at a corner, where it is a
    /// mean (docs/subdivision.md).
    [[nodiscard]] Point at(uint32_t quad, double u, double v) const;

private:
    /// (a, b): from the quarter's corner along its two edges, up to 1/2. Derivatives in a and b.
    [[nodiscard]] static Point inQuarter(const subdivision::LevelNet& net, uint32_t sector, double a, double b);

    std::shared_ptr<const subdivision::PosedLimit> own_; ///< null: the pose is another one's
    const subdivision::LimitPose* pose_;
};

} // namespace supple::surface::catmull_clark
