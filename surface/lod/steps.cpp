#include "surface/lod/steps.h"

#include "shaders/shared/specialization.h"

#include <iterator>

namespace supple::surface::lod {

static_assert(shared::kLodRecords % 4 == 0, "records are read as elements");

namespace {

constexpr uint32_t kScratchPadding = 16; ///< elements: instances start on 256 bytes

/// What measures edges, by Borders.
constexpr Kernel kEdgeKernels[] = {Kernel::lodEdge, Kernel::lodEdgeHalves, Kernel::lodEdgeTriangles,
                                   Kernel::lodEdgeCharts};
static_assert(std::size(kEdgeKernels) == static_cast<size_t>(Borders::charts) + 1);

/// What measures patches of a class, and leaves out those that show their backs where that is known.
struct PatchKernel {
    Kernel kernel = Kernel::lodPatch, facing = Kernel::lodPatchBackFaces;
    uint32_t kind = shared::kMeasuresNets;

    bool operator==(const PatchKernel&) const = default;
};
PatchKernel patchKernel(PatchClass patchClass) {
    const PatchClassRow& row = rowOf(patchClass);
    switch (row.borders) {
    case Borders::cubics:
        return {.kind = row.hasSectors() ? shared::kMeasuresSectors : shared::kMeasuresNets};
    case Borders::halves:
        return {Kernel::lodPatchHalves, Kernel::lodPatchHalves};
    case Borders::splines:
        return {Kernel::lodPatchTriangles, Kernel::lodPatchTriangles};
    case Borders::charts:
        break;
    }
    return {Kernel::lodPatchCharts, Kernel::lodPatchCharts};
}

/// Of `count` edges or patches from `first` on.
shared::LodPush pushFor(const ProgramBuilder& builder, uint32_t first, uint32_t count) {
    const Tables& tables = builder.tables;
    shared::LodPush push{};
    push.count = count;
    push.first = first;
    push.patches = tables.lod.patches.table;
    push.edgeCount = tables.lod.edgeCount;
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

void addEdges(ProgramBuilder& builder, uint32_t& argument) {
    Steps& steps = builder.program.edgeLevels;
    for (const LodTables::Edges& edges : builder.tables.lod.edges) {
        const gpu::Kernel kernel = builder.kernel(
            SetKind::levels, kEdgeKernels[static_cast<size_t>(edges.borders)], {}, "supple levels of edges");
        shared::LodPush push = pushFor(builder, edges.first, edges.section.count);
        push.edges = edges.section.table;
        builder.add(steps, SetKind::levels, kernel, builder.lanes(push.count), push, argument++,
                    steps.empty() ? Order::free : Order::disjoint);
    }
}

/// Neighbours that one kernel measures together. All count into one buffer, with atomics, and those of all windows too.
void addPatches(ProgramBuilder& builder, uint32_t& argument) {
    const std::vector<PatchRange>& ranges = builder.tables.ranges;
    for (size_t r = 0; r < ranges.size();) {
        const PatchKernel own = patchKernel(ranges[r].patchClass);
        const uint32_t first = ranges[r].firstPatch;
        uint32_t count = 0;
        for (; r < ranges.size() && patchKernel(ranges[r].patchClass) == own; ++r) {
            count += ranges[r].section.count;
        }
        const gpu::Kernel kernel = builder.kernel(SetKind::levels, builder.needs.backFaces ? own.facing : own.kernel,
                                                  {{shared::kKindConstant, own.kind}}, "supple levels of patches");
        builder.add(builder.program.patchLevels, SetKind::levels, kernel, builder.lanes(count),
                    pushFor(builder, first, count), argument++, Order::disjoint);
    }
}

} // namespace

void addSteps(ProgramBuilder& builder) {
    const LodTables& tables = builder.tables.lod;
    Program& program = builder.program;
    // A float an edge, then the words of patches (shaders/shared/lod.h).
    const uint32_t words = tables.edgeCount + shared::kLodPatchLevelWords * tables.patches.count;
    program.scratchStride = ((words + 3) / 4 + kScratchPadding - 1) / kScratchPadding * kScratchPadding;

    auto argument = static_cast<uint32_t>(builder.tables.constructions.size());
    if (builder.needs.levelOffset == 0) {
        addEdges(builder, argument);
    }
    addPatches(builder, argument);
    // Behind the solver. Between windows places are taken with atomics, but to synchronization validation the view's
    // words are one resource.
    const shared::LodPush push = pushFor(builder, 0, tables.patches.count);
    const gpu::Kernel place = builder.kernel(SetKind::levels, Kernel::lodPlace, {}, "supple level places");
    builder.add(program.places, SetKind::levels, place, builder.lanes(push.count), push, argument, Order::after);
}

} // namespace supple::surface::lod
