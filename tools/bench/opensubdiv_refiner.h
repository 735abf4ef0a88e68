// A cage as OpenSubdiv takes it. Only where OpenSubdiv is installed.
#pragma once

#include "cage/character.h"

#include <memory>
#include <opensubdiv/far/topologyRefiner.h>
#include <vector>

namespace supple::bench {

/// Values at the corners of faces, and how they are interpolated.
struct FaceVaryingChannel {
    std::vector<int> values; ///< per corner of the cage, the number of its value
    int count = 0;           ///< of values
    OpenSubdiv::Sdc::Options::FVarLinearInterpolation linear = OpenSubdiv::Sdc::Options::FVAR_LINEAR_ALL;
};

/// Creases, sharp vertices and holes as the cage has them, boundaries with sharp corners. Loop takes triangles alone.
/// `channel`: of face-varying values, or null.
[[nodiscard]] std::unique_ptr<OpenSubdiv::Far::TopologyRefiner>
opensubdivRefiner(const cage::Cage& cage, OpenSubdiv::Sdc::SchemeType scheme,
                  const FaceVaryingChannel* channel = nullptr);

} // namespace supple::bench
