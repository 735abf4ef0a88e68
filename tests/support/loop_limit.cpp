#include "tests/support/loop_limit.h"

#include "tests/support/bfr_surfaces.h"

namespace supple::test {

struct LoopLimit::Surfaces : BfrSurfaces {
    using BfrSurfaces::BfrSurfaces;
};

LoopLimit::LoopLimit(const cage::Cage& cage, const std::vector<glm::dvec3>& positions)
    : surfaces_(std::make_unique<Surfaces>(cage, positions, OpenSubdiv::Sdc::SCHEME_LOOP)) {}

LoopLimit::~LoopLimit() = default;

LoopLimit::Point LoopLimit::at(uint32_t face, double v, double w) const {
    const Surfaces::Face& f = surfaces_->faces[face];
    const double uv[2] = {v, w};
    Point point;
    f.surface.Evaluate(uv, f.points.data(), 3, &point.position.x, &point.du.x, &point.dv.x);
    return point;
}

} // namespace supple::test
