// What tells the surface schemes apart on one cage in one pose: each scheme's surface, as the device wrote it, against
// the Catmull-Clark limit surface.
#pragma once

#include "tools/common/character_file.h"
#include "tools/supple/evaluation.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::tools {

struct SchemeDeviation {
    std::string scheme;
    std::string refusal; ///< why the scheme does not take the cage; empty: it does
    uint32_t patches = 0;
    uint64_t samples = 0;
    double max = 0.0, mean = 0.0; ///< distances in asset units, over the samples
    uint32_t worstFace = 0;       ///< of the cage: where the largest distance is
    uint64_t normals = 0;         ///< samples whose normal could be compared
    double maxDegrees = 0.0, meanDegrees = 0.0;
    uint32_t worstNormalFace = 0;
    std::vector<std::string> notes;
};

struct Comparison {
    double extent = 0.0;         ///< the diagonal of the posed cage's bounding box, in asset units
    double measuringError = 0.0; ///< in asset units: the largest LimitSurface::Deviation::doubt
    std::vector<SchemeDeviation> schemes;
};

/// Fails where no scheme takes the cage, with what the first one says.
[[nodiscard]] Result<Comparison> compareSchemes(Session& session, const host::CharacterFile& file,
                                                const SurfaceFlags& surface, const Pose& pose);

} // namespace supple::tools
