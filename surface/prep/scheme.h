// p-rep as a scheme: which cages it takes, and the static tables it makes of one.
#pragma once

#include "base/result.h"
#include "cage/topology.h"
#include "surface/prep/weights.h"
#include "surface/scheme.h"

#include <cstdint>

namespace supple::surface::prep {

/// p-rep takes cages of quads, closed or with boundaries, that pass cage::buildTopology. Otherwise the reason: "face 12
/// has 5 sides: p-rep takes quads only". Creases are not looked at.
[[nodiscard]] Status accepts(const cage::Cage& cage);

/// Whether an edge carries a perturbation: an interior edge with an irregular end.
[[nodiscard]] bool isPerturbed(const cage::Cage& cage, const cage::Topology& topology, uint32_t edge);

/// `cage` must be accepted. O(faces).
[[nodiscard]] Tables buildTables(const cage::Cage& cage, const cage::Topology& topology, const Options& options);

} // namespace supple::surface::prep
