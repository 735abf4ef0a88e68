// The kernels that construct the coefficients of both exact schemes. Private to exact/.
#pragma once

#include "shaders/shared/exact.h"
#include "surface/scheme.h"
#include "surface/subdivision_rules.h"

namespace supple::surface::exact {

/// The kernel for plain vertices of a mesh: closed ones, or those on creases. `inPool`: the mesh is not the cage.
[[nodiscard]] constexpr KindOfKernel plainVertexKernel(bool closed, bool inPool) {
    constexpr KindOfKernel kKernels[] = {
        {Kernel::exactVertex, shared::kRegularFan},
        {Kernel::exactVertex, shared::kFewFan},
        {Kernel::exactVertexMeshInPool, shared::kRegularFan},
        {Kernel::exactVertexMeshInPool, shared::kFewFan},
    };
    return kKernels[(closed ? 0 : 1) + (inPool ? 2 : 0)];
}

/// The variant of the chain kernel that makes limits, chains, or a level of chains.
[[nodiscard]] constexpr KindOfKernel chainKernel(Subdivision subdivision, uint32_t makes, Stage stage) {
    const bool loop = subdivision == Subdivision::loop;
    if (stage == Stage::deepen) {
        return {loop ? Kernel::exactChainLevelsTriangles : Kernel::exactChainLevels, makes};
    }
    return {loop ? Kernel::exactChainTriangles : Kernel::exactChain, makes};
}

} // namespace supple::surface::exact
