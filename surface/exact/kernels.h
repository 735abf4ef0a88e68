// The kernels that construct the coefficients of both exact schemes. Private to exact/.
#pragma once

#include "shaders/shared/exact.h"
#include "surface/scheme.h"
#include "surface/subdivision_rules.h"

namespace supple::surface::exact {

/// Of plain vertices of a mesh: closed ones, and those on creases. `inPool`: the mesh is not the cage.
[[nodiscard]] constexpr KindOfKernel plainVertexKernel(bool closed, bool inPool) {
    constexpr KindOfKernel kKernels[] = {
        {Kernel::exactVertex, shared::kRegularFan, "supple exact vertex, regular"},
        {Kernel::exactVertex, shared::kFewFan, "supple exact vertex, creased"},
        {Kernel::exactVertexMeshInPool, shared::kRegularFan, "supple exact vertex of a step, regular"},
        {Kernel::exactVertexMeshInPool, shared::kFewFan, "supple exact vertex of a step, creased"},
    };
    return kKernels[(closed ? 0 : 1) + (inPool ? 2 : 0)];
}

/// The variant of the chain kernel that makes limits, chains, or a level of chains.
[[nodiscard]] constexpr KindOfKernel chainKernel(Subdivision subdivision, uint32_t makes, Stage stage) {
    constexpr const char* kNames[] = {"supple exact limits", "supple exact chains, first level",
                                      "supple exact chains, level", "supple exact chains"};
    const bool loop = subdivision == Subdivision::loop;
    if (stage == Stage::deepen) {
        return {loop ? Kernel::exactChainLevelsTriangles : Kernel::exactChainLevels, makes, kNames[makes]};
    }
    return {loop ? Kernel::exactChainTriangles : Kernel::exactChain, makes, kNames[makes]};
}

} // namespace supple::surface::exact
