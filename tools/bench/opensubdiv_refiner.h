// A cage as OpenSubdiv takes it. Only where OpenSubdiv is installed.
#pragma once

#include "cage/character.h"

#include <memory>
#include <opensubdiv/far/topologyRefiner.h>

namespace supple::bench {

/// Creases, sharp vertices and holes as the cage has them, boundaries with sharp corners. Loop takes triangles alone.
[[nodiscard]] std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> opensubdivRefiner(const cage::Cage& cage,
                                                                                  OpenSubdiv::Sdc::SchemeType scheme);

} // namespace supple::bench
