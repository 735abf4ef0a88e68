// What a surface is built of, before anything of it lies on the device: who draws it, its tables, what its passes
// write, its rates, and what a host is told about them.
#pragma once

#include "runtime/asset.h"
#include "runtime/culling/bounds_kernels.h"
#include "runtime/part_schemes.h"
#include "runtime/surface_outputs.h"
#include "runtime/surface_recipe.h"
#include "runtime/view.h"
#include "surface/programs.h"

#include <memory>
#include <string>
#include <vector>

namespace supple::runtime {

class Tessellation;

/// What a tessellation is made of. All pointers must outlive it.
struct TessellationDesc {
    const gpu::Device* device = nullptr;
    surface::Programs* programs = nullptr;
    BoundsKernels* bounds = nullptr; ///< groups of a view
    const gpu::StaticBuffers* pairs = nullptr;
    std::shared_ptr<View> view; ///< null, or the group's
    Asset* asset = nullptr;
    SuppleGroupDesc group{};              ///< `scheme` is the surface's
    std::vector<uint32_t> parts;          ///< rising
    std::shared_ptr<AssetPiece> piece;    ///< those parts; null: all of the asset's
    bool schemeChosen = false;            ///< the host left it to Supple: outputs that the scheme lacks are left out
    uint32_t surface = 0;                 ///< its number in the group
    const Tessellation* before = nullptr; ///< during creation: the surface whose place it takes; null: none
    const Tessellation* leader = nullptr; ///< of the group that this one follows, if that may share coefficients
    bool countsHidden = true;             ///< it has the first patches at levels of the group
    uint32_t framesInFlight = 2;
    bool handsOver = false; ///< to another queue family: all output is written anew in every frame
};

struct BuiltSurface {
    std::shared_ptr<SchemeTables> scheme; ///< never null; without tables before buildSurface()
    SurfaceOutputs outputs;
    uint32_t askedRate = 8; ///< segments along an edge of the cage
    uint32_t beginRate = 8; ///< the same along a patch edge, as the scheme has them
    std::string rateNote;   ///< why the rate is not the one asked for, or empty
    std::string uvNote;     ///< why texture coordinates are linear though the file says otherwise, or empty

    [[nodiscard]] const surface::Tables& tables() const { return scheme->tables(); }
};

/// Without tables: what the host asks for.
[[nodiscard]] BuiltSurface askedSurface(const TessellationDesc& desc);
/// With the tables of the description, which the asset finds or builds. Refuses what the scheme cannot take.
[[nodiscard]] Result<BuiltSurface> buildSurface(const TessellationDesc& desc);
/// What the program of a surface is made for. What a view adds, its tessellations fill in.
[[nodiscard]] surface::ProgramOptions programOptionsOf(const TessellationDesc& desc, const BuiltSurface& built);

} // namespace supple::runtime
