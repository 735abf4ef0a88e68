// A kernel's SPIR-V, for either mapping and for shared dispatches: supple_embed_kernels (cmake/supple_shaders.cmake)
// writes one a shader.
#pragma once

#include <cstdint>
#include <span>

namespace supple::gpu {

struct Spirv {
    std::span<const uint32_t> narrow, wide; ///< by Mapping::wide
    std::span<const uint32_t> tasks;        ///< wide, of a task (gpu/tasks.h); empty where groups do not share it
};

} // namespace supple::gpu
