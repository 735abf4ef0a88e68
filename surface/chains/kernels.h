// The kernels that construct the coefficients of both exact schemes. Private to chains/.
#pragma once

#include "shaders/shared/chains.h"
#include "surface/scheme.h"
#include "surface/subdivision_rules.h"

namespace supple::surface::chains {

/// The kernel for plain vertices of a mesh. `kind`: shared::kPointsFan and kRegularFan of closed ones, kFewFan of those
/// on creases. `inPool`: the mesh is not the cage.
[[nodiscard]] constexpr KindOfKernel plainVertexKernel(uint32_t kind, bool inPool) {
    return {inPool ? Kernel::chainsVertexMeshInPool : Kernel::chainsVertex, kind};
}

/// The variant of the chain kernel that makes limits, chains, or a level of chains.
[[nodiscard]] constexpr KindOfKernel chainKernel(Subdivision subdivision, uint32_t makes, Stage stage) {
    const bool loop = subdivision == Subdivision::loop;
    if (stage == Stage::deepen) {
        return {loop ? Kernel::chainsChainLevelsTriangles : Kernel::chainsChainLevels, makes};
    }
    return {loop ? Kernel::chainsChainTriangles : Kernel::chainsChain, makes};
}

} // namespace supple::surface::chains
