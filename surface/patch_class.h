// The classes of patches: a table with one row per class.
#pragma once

#include "shaders/lod/lines.h"
#include "shaders/shared/chains.h"
#include "shaders/shared/lod.h"
#include "shaders/shared/pm.h"
#include "shaders/shared/specialization.h"
#include "shaders/shared/surface.h"
#include "surface/grid.h"
#include "surface/kernels.h"

#include <cstdint>

namespace supple::surface {

namespace lod {

/// Forms of the grids that patches are drawn with at levels.
///
///   quad    bicubic patches, including polar ones: (R+1)^2 samples (i, j), u fastest
///   rings   patches of m sectors, m = 3, 4, 5: ring r = 0..(R-1)/2 has m (R - 2r) samples: side s = 0..m-1, then
///           k = r..R-r-1 (k = R-r is the next side's k = r); m (R+1)^2 / 4 samples in all. The sample's weights of
///           corner s, corner s+1 and the centre are (t_{R-k} - t_r, t_k - t_r, 2 t_r)
enum class Form : uint32_t {
    quad = shared::kLodQuadForm,
    triangleRings = shared::kLodTriangleForm,
    quadRings = shared::kLodQuadRingsForm,
    pentagonRings = shared::kLodPentagonForm
};

} // namespace lod

/// What the borders of patches and the edges between them are.
enum class Borders : uint8_t {
    cubics,
    halves,       ///< exact Catmull-Clark: cubics, or two halves, each of its end's leaves
    splines,      ///< Loop: quartic box splines, one an edge; of a patch, also two
    splineHalves, ///< Loop, edges alone: two halves, each of its end's leaves
    sharpHalves,  ///< the same, of a semi-sharp crease
    charts        ///< blends of two charts
};

enum class PatchClass : uint32_t {
    regular = shared::kRegularPatch,     ///< bicubic
    perturbed = shared::kPerturbedPatch, ///< p-rep: bicubic and a sparse perturbation of degree 5
    polar = shared::kPolarPatch,         ///< P_m: a triangle of a polar fan, bicubic with a collapsed side
    p3 = shared::kP3Patch,               ///< P_m: three, four, five triangular sectors of degree 4
    p4 = shared::kP4Patch,
    p5 = shared::kP5Patch,
    fragment = shared::kFragmentPatch, ///< subdivision: a face of the isolated level
    loop = shared::kLoopPatch,
    blend = shared::kBlendPatch,           ///< blending surface: smooth all over
    blendSharp = shared::kBlendSharpPatch, ///< with creases, or without derivatives somewhere on its border
    triangle = shared::kTrianglePatch,     ///< polygons: a triangle of a face
    irregular = shared::kIrregularPatch, ///< exact Catmull-Clark: a quad of leaves, some corner having a chain of them
    irregularSharp = shared::kIrregularSharpPatch,         ///< some side is a crease, too
    creased = shared::kCreasedPatch,                       ///< no corner has a chain, but a semi-sharp crease passes
    loopRegular = shared::kLoopRegularPatch,               ///< exact Loop: a quartic box spline
    loopIrregular = shared::kLoopIrregularPatch,           ///< some corner has a chain of leaves
    loopIrregularSharp = shared::kLoopIrregularSharpPatch, ///< some side is a semi-sharp crease, too
    blendRegular = shared::kBlendRegularPatch              ///< blending surface: all charts have k = 4, none is creased
};

struct PatchClassRow {
    const char* name = "";
    Domain domain = Domain::quad;
    uint32_t coefficients = 0;   ///< of a patch, as the patch pass writes them; 0: it has none
    uint32_t recordElements = 0; ///< table elements of a patch, but for corner normals (Tables::cornerNormals)
    // The kernels that evaluate it. The subdivision evaluates fragments (Tables::fragments) instead.
    Kernel evaluate = Kernel::count; ///< at a rate
    Kernel atLevels = Kernel::count;
    Kernel patch = Kernel::count;     ///< writes the coefficients
    lod::Form form = lod::Form::quad; ///< of its grids at levels
    Borders borders = Borders::cubics;
    bool ownNarrow = false, ownWide = false; ///< by mapping: a pipeline of its own for a rate pays
    uint32_t netElements = 0;                ///< what a patch takes of a workgroup's memory in the wide mapping, where
                                             ///< a lane takes a row of its samples. 0: a lane takes a sample, or see
                                             ///< hasQuarters()
    /// For tables with fan records (Tables::fanRecords), in the place of `evaluate` and `patch`.
    Kernel evaluateRecords = Kernel::count, patchOfRecords = Kernel::count;
    [[nodiscard]] constexpr bool hasRows() const { return netElements > 0; }
    [[nodiscard]] constexpr bool isBicubic() const { return hasRows() && borders == Borders::cubics; }
    /// Exact Catmull-Clark: in the wide mapping a lane takes a quarter at a rate.
    [[nodiscard]] constexpr bool hasQuarters() const { return borders == Borders::halves; }
    /// P_m: triangular sectors round a centre.
    [[nodiscard]] constexpr bool hasSectors() const { return hasRings() && borders == Borders::cubics; }
    /// At levels its samples lie in rings.
    [[nodiscard]] constexpr bool hasRings() const { return form != lod::Form::quad; }
};

inline constexpr PatchClassRow kPatchClasses[] = {
    {"regular", Domain::quad, 16, 2, Kernel::evaluateBicubic, Kernel::evaluateBicubicLevelsRegular,
     Kernel::evaluatePatch, lod::Form::quad, Borders::cubics, true, true, shared::kWideNetElements,
     Kernel::evaluateBicubicFanRecords, Kernel::evaluatePatchFanRecords},
    {"perturbed", Domain::quad, 32, 3, Kernel::evaluateBicubic, Kernel::evaluateBicubicLevels, Kernel::evaluatePatch,
     lod::Form::quad, Borders::cubics, true, true, shared::kWidePerturbedNetElements, Kernel::evaluateBicubicFanRecords,
     Kernel::evaluatePatchFanRecords},
    {"polar", Domain::polar, 13, 2, Kernel::evaluateBicubic, Kernel::evaluateBicubicLevels, Kernel::evaluatePatch,
     lod::Form::quad, Borders::cubics, false, true, shared::kWideNetElements},
    {"p3", Domain::triangle, 19, SUPPLE_PM_RECORD_ELEMENTS(3u), Kernel::pmEvaluate, Kernel::pmEvaluateLevels,
     Kernel::pmPatch, lod::Form::triangleRings},
    {"p4", Domain::quad, 25, SUPPLE_PM_RECORD_ELEMENTS(4u), Kernel::pmEvaluate, Kernel::pmEvaluateLevels,
     Kernel::pmPatch, lod::Form::quadRings},
    {"p5", Domain::pentagon, 31, SUPPLE_PM_RECORD_ELEMENTS(5u), Kernel::pmEvaluate, Kernel::pmEvaluateLevels,
     Kernel::pmPatch, lod::Form::pentagonRings},
    {"fragment", Domain::quad},
    {"loop", Domain::triangle},
    {"blend", Domain::quad, 0, 4, Kernel::blendEvaluate, Kernel::blendEvaluateLevels, Kernel::count, lod::Form::quad,
     Borders::charts},
    {"blend-sharp", Domain::quad, 0, 4, Kernel::blendEvaluate, Kernel::blendEvaluateLevels, Kernel::count,
     lod::Form::quad, Borders::charts},
    {"triangle", Domain::triangle},
    {"irregular", Domain::quad, 0, shared::kQuadRecordElements, Kernel::catmullClarkEvaluate,
     Kernel::catmullClarkEvaluateLevels, Kernel::count, lod::Form::quad, Borders::halves},
    {"irregular-sharp", Domain::quad, 0, shared::kSharpQuadElements, Kernel::catmullClarkEvaluate,
     Kernel::catmullClarkEvaluateLevels, Kernel::count, lod::Form::quad, Borders::halves},
    {"creased", Domain::quad, 0, shared::kSharpQuadElements, Kernel::catmullClarkEvaluate,
     Kernel::catmullClarkEvaluateLevels, Kernel::count, lod::Form::quad, Borders::halves},
    {"loop-regular", Domain::triangle, 0, shared::kTriangleElements, Kernel::loopEvaluate, Kernel::loopEvaluateLevels,
     Kernel::count, lod::Form::triangleRings, Borders::splines},
    {"loop-irregular", Domain::triangle, 0, shared::kIrregularTriangleElements, Kernel::loopEvaluate,
     Kernel::loopEvaluateLevels, Kernel::count, lod::Form::triangleRings, Borders::splines},
    {"loop-irregular-sharp", Domain::triangle, 0, shared::kSharpTriangleElements, Kernel::loopEvaluate,
     Kernel::loopEvaluateLevels, Kernel::count, lod::Form::triangleRings, Borders::splines},
    {"blend-regular", Domain::quad, 0, 4, Kernel::blendEvaluate, Kernel::blendEvaluateLevels, Kernel::count,
     lod::Form::quad, Borders::charts, true, true, shared::kWideBlendElements},
};

[[nodiscard]] constexpr const PatchClassRow& rowOf(PatchClass patchClass) {
    return kPatchClasses[static_cast<uint32_t>(patchClass)];
}
[[nodiscard]] constexpr const char* className(PatchClass patchClass) {
    return rowOf(patchClass).name;
}
/// At levels a lane of the wide mapping takes a line of samples: lines.glsl of bicubic patches and Catmull-Clark, and
/// evaluate.comp of P_m, Loop and the blending surface. Kernels are told (kLinesConstant, kRunHasLines).
[[nodiscard]] constexpr bool hasLines(PatchClass patchClass) {
    return rowOf(patchClass).isBicubic() || rowOf(patchClass).hasSectors() || rowOf(patchClass).hasQuarters() ||
           patchClass == PatchClass::loopRegular || patchClass == PatchClass::blendRegular;
}
static_assert(shared::kMostLines <= shared::kMaxLanes, "a workgroup has a lane for each line of a patch");
[[nodiscard]] constexpr Domain domainOf(PatchClass patchClass) {
    return rowOf(patchClass).domain;
}

} // namespace supple::surface
