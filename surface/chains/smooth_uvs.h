// Smooth texture coordinates of exact patches (docs/smooth_uvs.md): a quad or a triangle is to its texture coordinates
// what an irregular one is to positions, two numbers a point. Private to chains/.
#pragma once

#include "surface/build.h"
#include "surface/chains/fan_tables.h"

namespace supple::surface::chains {

/// What smooth texture coordinates are made of.
struct UvDemand {
    Subdivision subdivision = Subdivision::catmullClark;
    bool steps = false;     ///< patches are made of what one step makes of the cage
    uint32_t lastLevel = 0; ///< of chains
};

/// Writes the points of all UV sets and a record a patch and set, if the recipe asks for smooth texture coordinates and
/// the cage has any. Quads have kSharpQuadElements, triangles what an irregular one has from its corners on.
[[nodiscard]] Status writeUvLeaves(const Recipe& recipe, const cage::Cage& cage, const UvDemand& demand,
                                   const std::vector<DraftPatch>& patches, FanTables& fans, TableWriter& writer,
                                   Tables& tables);

} // namespace supple::surface::chains
