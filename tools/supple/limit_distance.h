// How far a figure's surface lies from the Catmull-Clark limit of its cage: values for the view kViewDistance.
#pragma once

#include "cage/character.h"
#include "host/figure.h"
#include "tools/supple/legend.h"

#include <string>
#include <vector>

namespace supple::tools {

/// A group as it was evaluated last, read back.
struct PosedSurfaces {
    std::string path;                ///< of the figure
    std::vector<glm::vec3> vertices; ///< FigureGroup::readSurface()
    std::vector<glm::vec3> cage;
    struct Surface {
        std::vector<SuppleDrawRange> ranges; ///< none: it is no smooth surface
        std::vector<SupplePatchInfo> patches;
        size_t vertexCount = 0;
        SuppleScheme scheme = SUPPLE_SCHEME_AUTO;
        uint32_t rate = 0; ///< along a patch
        std::vector<uint32_t> parts;
    };
    std::vector<Surface> surfaces;
};
/// Waits for the device.
[[nodiscard]] Result<PosedSurfaces> readPosed(const host::FigureGroup& group);

/// Of every vertex: where its distance lies on the scale. `cage`: the figure's. Vertices of parts that the scheme
/// polygons draws have none. Any thread may call it.
[[nodiscard]] Result<std::vector<float>> distancesToLimit(const PosedSurfaces& posed, const cage::Cage& cage);

/// The scale: logarithmic, in fractions of the diagonal of the box round the cage.
[[nodiscard]] std::vector<Legend::Mark> distanceMarks();

} // namespace supple::tools
