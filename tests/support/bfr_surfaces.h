// OpenSubdiv's Bfr surfaces of all faces of a cage, in double. Private to the limits of tests/support.
#pragma once

#include "tools/bench/opensubdiv_refiner.h"

#include <memory>
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <vector>

namespace supple::test {

/// Bfr 3.5.0 crashes on irregular facets at 12.
inline constexpr int kApproximationLevel = 10;

struct BfrSurfaces {
    struct Face {
        OpenSubdiv::Bfr::Surface<double> surface; ///< not valid for holes
        std::vector<double> points;
    };

    BfrSurfaces(const cage::Cage& cage, const std::vector<glm::dvec3>& positions, OpenSubdiv::Sdc::SchemeType scheme)
        : refiner(bench::opensubdivRefiner(cage, scheme)),
          factory(*refiner, OpenSubdiv::Bfr::SurfaceFactory::Options()
                                .SetApproxLevelSmooth(kApproximationLevel)
                                .SetApproxLevelSharp(kApproximationLevel)),
          faces(cage.faceCount()) {
        for (uint32_t f = 0; f < cage.faceCount(); ++f) {
            Face& face = faces[f];
            if (factory.InitVertexSurface(static_cast<int>(f), &face.surface)) {
                face.points.resize(3 * static_cast<size_t>(face.surface.GetNumPatchPoints()));
                face.surface.PreparePatchPoints(&positions[0].x, 3, face.points.data(), 3);
            }
        }
    }

    std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner;
    OpenSubdiv::Bfr::RefinerSurfaceFactory<> factory;
    std::vector<Face> faces;
};

} // namespace supple::test
