// p-rep as a scheme: which cages it takes, and the static tables that it makes of them.
#pragma once

#include "base/result.h"
#include "cage/topology.h"
#include "surface/recipe.h"
#include "surface/scheme.h"

#include <cstdint>

namespace supple::surface::prep {

/// Whether an edge has a perturbation: it is interior, and one of its ends is irregular.
[[nodiscard]] bool isPerturbed(const cage::Cage& cage, const cage::Topology& topology, uint32_t edge);

/// See surface::Scheme. Refuses a cage with faces other than quads: "face 12 has 5 sides: p-rep takes quads only". The
/// cage may have boundaries. Creases are ignored. O(faces).
[[nodiscard]] Result<Tables> build(const Recipe& recipe, const cage::Cage& cage);

} // namespace supple::surface::prep
