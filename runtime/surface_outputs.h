// What the passes of a surface write: what the group's description and the view's flags ask for, as far as the
// surface's tables have it.
#pragma once

#include "base/result.h"
#include "runtime/vertex_streams.h"
#include "surface/program_options.h"
#include "surface/schemes.h"

#include <cstdint>
#include <optional>
#include <string>

namespace supple::runtime {

struct OutputWish {
    const std::string& name; ///< of the character
    uint32_t groupFlags = 0;
    std::optional<uint32_t> viewFlags;            ///< of a group of a view
    SuppleVertexFormat format = SUPPLE_VERTEX_16; ///< the group's or the view's
    bool schemeChosen = false; ///< the host left it to Supple: outputs that the scheme lacks are left out
};

struct SurfaceOutputs {
    StreamSet streams;
    bool patches = false; ///< SUPPLE_GROUP_PATCHES
};
/// Refuses patch coefficients that the host has asked for and the scheme does not have.
[[nodiscard]] Result<SurfaceOutputs> surfaceOutputs(const OutputWish& wish, const surface::Tables& tables,
                                                    const char* scheme);
/// Segments along a patch edge that a group begins with, which asks for so many along an edge of the cage.
[[nodiscard]] uint32_t beginRate(uint32_t asked, const surface::Tables& tables, surface::RateRule rates);
/// For Programs::prepare(), of a group without a view that begins with a rate. What a view adds, its tessellations fill
/// in.
[[nodiscard]] surface::ProgramOptions programOptionsOf(const OutputWish& wish, const SurfaceOutputs& outputs,
                                                       uint32_t rate);

} // namespace supple::runtime
