// OpenSubdiv's GLComputeEvaluator: GLSL compute shaders that write position, du and dv (36 bytes) a point. Only where
// OpenSubdiv's GPU library and EGL are installed.
#pragma once

#include "tools/bench/gl_context.h"
#include "tools/bench/opensubdiv_tables.h"
#include "tools/bench/peer.h"

namespace supple::bench {

/// By limit stencils, and by patches of points refined anew. `gl` is current and outlives the peers.
[[nodiscard]] Result<std::vector<Peer>> opensubdivGlslPeers(const GlContext& gl,
                                                            const std::shared_ptr<const OpensubdivTables>& tables);

} // namespace supple::bench
