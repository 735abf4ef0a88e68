#include "tests/support/loop_limit.h"

#include "tools/bench/opensubdiv_refiner.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>

namespace supple::test {

using namespace OpenSubdiv;

struct LoopLimit::Surfaces {
    struct Face {
        Bfr::Surface<double> surface; ///< not valid for holes
        std::vector<double> points;
    };

    Surfaces(const cage::Cage& cage, const std::vector<glm::dvec3>& positions)
        : refiner(bench::opensubdivRefiner(cage, Sdc::SCHEME_LOOP)),
          factory(*refiner, Bfr::SurfaceFactory::Options().SetApproxLevelSmooth(10).SetApproxLevelSharp(10)),
          faces(cage.faceCount()) {
        for (uint32_t f = 0; f < cage.faceCount(); ++f) {
            Face& face = faces[f];
            if (factory.InitVertexSurface(static_cast<int>(f), &face.surface)) {
                face.points.resize(3 * static_cast<size_t>(face.surface.GetNumPatchPoints()));
                face.surface.PreparePatchPoints(&positions[0].x, 3, face.points.data(), 3);
            }
        }
    }

    std::unique_ptr<Far::TopologyRefiner> refiner;
    Bfr::RefinerSurfaceFactory<> factory;
    std::vector<Face> faces;
};

LoopLimit::LoopLimit(const cage::Cage& cage, const std::vector<glm::dvec3>& positions)
    : surfaces_(std::make_unique<Surfaces>(cage, positions)) {}

LoopLimit::~LoopLimit() = default;

LoopLimit::Point LoopLimit::at(uint32_t face, double v, double w) const {
    const Surfaces::Face& f = surfaces_->faces[face];
    const double uv[2] = {v, w};
    Point point;
    f.surface.Evaluate(uv, f.points.data(), 3, &point.position.x, &point.du.x, &point.dv.x);
    return point;
}

} // namespace supple::test
