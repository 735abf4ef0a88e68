// A kernel's SPIR-V, for either mapping: supple_embed_kernels (cmake/supple_shaders.cmake) writes one a shader.
#pragma once

#include <cstdint>
#include <span>

namespace supple::gpu {

struct Spirv {
    std::span<const uint32_t> narrow, wide; ///< by Mapping::wide
};

} // namespace supple::gpu
