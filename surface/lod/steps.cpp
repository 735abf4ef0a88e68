#include "surface/lod/steps.h"

#include "shaders/shared/specialization.h"
#include "surface/construction_names.h"
#include "surface/table_header.h"

#include <iterator>

namespace supple::surface::lod {

namespace {

/// What measures edges, by Borders.
struct EdgeKernel {
    Kernel kernel = Kernel::lodEdge;
    uint32_t kind = 0;
};
constexpr EdgeKernel kEdgeKernels[] = {{Kernel::lodEdge},
                                       {Kernel::lodEdgeHalves},
                                       {Kernel::lodEdgeTriangles, shared::kMeasuresWholeSides},
                                       {Kernel::lodEdgeTriangles, shared::kMeasuresHalves},
                                       {Kernel::lodEdgeTriangles, shared::kMeasuresSharpHalves},
                                       {Kernel::lodEdgeCharts}};
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
    case Borders::splineHalves: // edges alone have these
    case Borders::sharpHalves:
        return patchClass == PatchClass::loopRegular
                   ? PatchKernel{Kernel::lodPatchTriangles, Kernel::lodPatchBackFacesTriangles,
                                 shared::kMeasuresRegularTriangles}
                   : PatchKernel{Kernel::lodPatchTriangles, Kernel::lodPatchTriangles,
                                 shared::kMeasuresIrregularTriangles};
    case Borders::charts:
        break;
    }
    return {Kernel::lodPatchCharts, Kernel::lodPatchCharts};
}

/// The push constants for `count` edges or patches from `first` on.
shared::LodPush pushFor(const ProgramBuilder& builder, uint32_t first, uint32_t count) {
    shared::LodPush push{};
    push.count = count;
    push.first = first;
    push.levels = builder.options.levelOffset;
    push.masks = builder.options.firstMask;
    push.maskWords = builder.options.maskWords;
    push.countsHidden = builder.options.countsHidden ? 1 : 0;
    push.runs = builder.options.viewRuns;
    return push;
}

void addEdges(ProgramBuilder& builder, uint32_t& argument) {
    Steps& steps = builder.program.edgeLevels;
    for (const LodTables::Edges& edges : builder.tables.lod.edges) {
        const EdgeKernel& own = kEdgeKernels[static_cast<size_t>(edges.borders)];
        const gpu::Kernel kernel =
            builder.kernel(SetKind::levels, own.kernel, {{shared::kKindConstant, own.kind}}, "supple levels of edges");
        shared::LodPush push = pushFor(builder, edges.first, edges.section.count);
        push.table = edges.section.table;
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
        const gpu::Kernel kernel = builder.kernel(SetKind::levels, builder.options.backFaces ? own.facing : own.kernel,
                                                  {{shared::kKindConstant, own.kind}}, "supple levels of patches");
        builder.add(builder.program.patchLevels, SetKind::levels, kernel, builder.lanes(count),
                    pushFor(builder, first, count), argument++, Order::shared);
    }
}

/// Lists instances by how far their chains go, and makes these levels.
void addDepths(ProgramBuilder& builder) {
    const LodTables& tables = builder.tables.lod;
    Program& program = builder.program;
    if (tables.depth == 0) {
        return;
    }
    const gpu::Kernel kernel = builder.kernel(SetKind::levels, Kernel::lodDepth, {}, "supple depths of chains");
    builder.add(program.depths, SetKind::levels, kernel, DispatchSize::oneGroup(), pushFor(builder, 0, 1));
    program.firstDepthDispatch = depthWords(tables) + shared::kDepthDispatches;
    uint32_t depth = 0;
    for (const Construction& c : builder.tables.constructions) {
        if (c.stage != Stage::deepen) {
            continue;
        }
        const gpu::Kernel own = builder.kernel(SetKind::levels, c.kernel.kernel,
                                               {{shared::kKindConstant, c.kernel.kind}}, constructionName(c.kernel));
        auto push = surface::pushFor<shared::DepthPush>(c.section);
        push.depth = depth;
        builder.add(program.deepen, SetKind::levels, own, builder.lanes(push.count), push, depth,
                    depth == 0 ? Order::free : Order::after);
        ++depth;
    }
}

} // namespace

void addSteps(ProgramBuilder& builder) {
    const LodTables& tables = builder.tables.lod;
    Program& program = builder.program;
    program.scratchStride = scratchStride(builder.tables);

    auto argument = static_cast<uint32_t>(builder.tables.constructions.size());
    if (builder.options.levelOffset == 0) {
        addEdges(builder, argument);
    }
    addPatches(builder, argument);
    addDepths(builder);
    // Places are taken with atomics, but to synchronization validation the view's words are one resource.
    const shared::LodPush push = pushFor(builder, 0, tables.patches.count);
    const gpu::Kernel place = builder.kernel(SetKind::levels, Kernel::lodPlace, {}, "supple level places");
    builder.add(program.places, SetKind::levels, place, builder.lanes(push.count), push, argument, Order::shared);
}

} // namespace supple::surface::lod
