// OpenSubdiv's CpuEvaluator: position, du and dv (36 bytes) a point on one thread. Only where OpenSubdiv is installed.
#pragma once

#include "tools/bench/opensubdiv_tables.h"
#include "tools/bench/peer.h"

namespace supple::bench {

/// By limit stencils, and by patches of points refined anew.
[[nodiscard]] std::vector<Peer> opensubdivCpuPeers(const std::shared_ptr<const OpensubdivTables>& tables);

} // namespace supple::bench
