// p-rep as a scheme: which cages it takes, and the static tables that it makes of them.
#pragma once

#include "base/result.h"
#include "cage/topology.h"
#include "surface/prep/weights.h"
#include "surface/recipe.h"
#include "surface/scheme.h"

#include <cstdint>

namespace supple::surface::prep {

/// Refuses a cage with faces other than quads: "face 12 has 5 sides: p-rep takes quads only". The cage passes
/// cage::buildTopology. It may have boundaries. Creases are ignored.
[[nodiscard]] Status accepts(const cage::Cage& cage);

/// Whether an edge has a perturbation: it is interior, and one of its ends is irregular.
[[nodiscard]] bool isPerturbed(const cage::Cage& cage, const cage::Topology& topology, uint32_t edge);

/// `cage` must be accepted. O(faces).
[[nodiscard]] Tables buildTables(const cage::Cage& cage, const cage::Topology& topology, const Options& options);

/// See surface::Scheme.
[[nodiscard]] Result<Tables> build(const Recipe& recipe, const cage::Cage& cage);

} // namespace supple::surface::prep
