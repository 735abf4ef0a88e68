// How far a figure's surface lies from the Catmull-Clark limit of its cage: values for the view kViewDistance.
#pragma once

#include "cage/character.h"
#include "host/figure.h"
#include "tools/supple/legend.h"

#include <vector>

namespace supple::tools {

/// Of every vertex of the group's surfaces, in the order of FigureGroup::readSurface(): where the distance lies on the
/// scale. `cage`: the figure's. The cage is as the group has deformed it last. Vertices of parts that the scheme
/// polygons draws have none: their surface is no smooth one. No frame may be pending.
[[nodiscard]] Result<std::vector<float>> distancesToLimit(const host::FigureGroup& group, const cage::Cage& cage);

/// The scale: logarithmic, in fractions of the diagonal of the box round the cage.
[[nodiscard]] std::vector<Legend::Mark> distanceMarks();

} // namespace supple::tools
