#include "surface/lod/steps.h"

#include <iterator>

namespace supple::surface::lod {

static_assert(shared::kLodRecords % 4 == 0, "records are read as elements");

namespace {

constexpr uint32_t kScratchPadding = 16; ///< elements: instances start on 256 bytes

/// What measures edges and patches, by Borders.
struct MeasureKernels {
    Kernel edge, patch, patchFacing; ///< patchFacing leaves out patches that show their backs
};
constexpr MeasureKernels kMeasureKernels[] = {
    {Kernel::lodEdge, Kernel::lodPatch, Kernel::lodPatchBackFaces},
    {Kernel::lodEdgeHalves, Kernel::lodPatchHalves, Kernel::lodPatchHalvesBackFaces},
    // Nothing is known of where Loop patches and blends of charts face.
    {Kernel::lodEdgeTriangles, Kernel::lodPatchTriangles, Kernel::lodPatchTriangles},
    {Kernel::lodEdgeCharts, Kernel::lodPatchCharts, Kernel::lodPatchCharts},
};
static_assert(std::size(kMeasureKernels) == static_cast<size_t>(Borders::charts) + 1);

/// Of edges where `count` is edgeCount, else of patches.
shared::LodPush pushFor(const ProgramBuilder& builder, uint32_t count) {
    const Tables& tables = builder.tables;
    shared::LodPush push{};
    push.count = count;
    push.edges = tables.lod.edges.table;
    push.patches = tables.lod.patches.table;
    push.edgeCount = tables.lod.edges.count;
    push.poolStride = tables.poolStride;
    push.tangents = tables.tangents;
    push.faces = tables.faces;
    push.scratchStride = builder.program.scratchStride;
    push.runCount = static_cast<uint32_t>(tables.lod.runs.size());
    push.levels = builder.needs.levelOffset;
    push.masks = builder.needs.firstMask;
    push.maskWords = builder.needs.maskWords;
    return push;
}

} // namespace

void addSteps(ProgramBuilder& builder) {
    const LodTables& tables = builder.tables.lod;
    Program& program = builder.program;
    // A float an edge, then the words of patches (shaders/shared/lod.h).
    const uint32_t words = tables.edges.count + shared::kLodPatchLevelWords * tables.patches.count;
    program.scratchStride = ((words + 3) / 4 + kScratchPadding - 1) / kScratchPadding * kScratchPadding;

    const MeasureKernels& measure = kMeasureKernels[static_cast<size_t>(tables.borders)];
    const auto edges = static_cast<uint32_t>(builder.tables.constructions.size()), patches = edges + 1;
    if (builder.needs.levelOffset == 0) {
        const gpu::Kernel kernel = builder.kernel(SetKind::levels, measure.edge, {}, "supple levels of edges");
        builder.add(program.edgeLevels, SetKind::levels, kernel, builder.lanes(tables.edges.count),
                    pushFor(builder, tables.edges.count), edges);
    }
    const Kernel patch = builder.needs.backFaces ? measure.patchFacing : measure.patch;
    const shared::LodPush push = pushFor(builder, tables.patches.count);
    // Patches of all windows count into one buffer, with atomics.
    const gpu::Kernel level = builder.kernel(SetKind::levels, patch, {}, "supple levels of patches");
    builder.add(program.patchLevels, SetKind::levels, level, builder.lanes(push.count), push, patches, Order::disjoint);
    // Behind the solver. Between windows places are taken with atomics, but to synchronization validation the view's
    // words are one resource.
    const gpu::Kernel place = builder.kernel(SetKind::levels, Kernel::lodPlace, {}, "supple level places");
    builder.add(program.places, SetKind::levels, place, builder.lanes(push.count), push, patches, Order::after);
}

} // namespace supple::surface::lod
