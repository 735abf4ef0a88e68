// The SPIR-V of the surface passes.
#pragma once

#include "gpu/spirv.h"
#include "surface/kernels.h"

#include <array>
#include <cstddef>

namespace supple::surface {

/// SPIR-V by kernel. The kernels are listed in surface/CMakeLists.txt.
struct Shaders {
    std::array<gpu::Spirv, static_cast<size_t>(Kernel::count)> kernels;

    /// What was compiled at build time. Tests copy it and put mutations in.
    [[nodiscard]] static Shaders embedded();
    [[nodiscard]] gpu::Spirv& operator[](Kernel kernel) { return kernels[static_cast<size_t>(kernel)]; }
    [[nodiscard]] const gpu::Spirv& operator[](Kernel kernel) const { return kernels[static_cast<size_t>(kernel)]; }
};

} // namespace supple::surface
