#include "surface/steps.h"

#include "shaders/shared/specialization.h"
#include "surface/indexed_mesh.h"

#include <algorithm>
#include <iterator>

namespace supple::surface {

namespace {

using namespace shared;

/// In the narrow mapping a rate of its own unrolls all loops over a patch's samples, and what is compiled grows with
/// it; in the wide one it makes divisions cheap, and loops of many rounds stay.
constexpr uint32_t kUnrolledRates = 8;

bool ownRatePays(const ProgramBuilder& builder) {
    return builder.device.mapping.wide || builder.needs.rate <= kUnrolledRates;
}

bool ownRatePays(const ProgramBuilder& builder, PatchClass patchClass) {
    const PatchClassRow& row = rowOf(patchClass);
    return ownRatePays(builder) && (builder.device.mapping.wide ? row.ownWide : row.ownNarrow);
}

std::string atRate(const std::string& name, uint32_t rate) {
    return rate == 0 ? name : name + ", rate " + std::to_string(rate);
}

SurfacePush pushFor(const ProgramBuilder& builder, const Section& section) {
    const Tables& tables = builder.tables;
    const Evaluation& evaluation = builder.evaluation;
    SurfacePush push{};
    push.count = section.count;
    push.firstCorner = evaluation.firstCornerVertex;
    push.table = section.table;
    push.ring = tables.ring;
    push.cageStride = evaluation.cageStride;
    push.poolStride = tables.poolStride;
    push.tangents = tables.tangents;
    push.faces = tables.faces;
    push.inner = tables.inner;
    push.attributes = tables.attributes;
    push.attributeHalves = tables.attributeHalves ? 1 : 0;
    push.edgeClasses = tables.edgeClasses;
    push.rate = evaluation.rate;
    push.patchCount = static_cast<uint32_t>(tables.patches.size());
    push.verticesPerInstance = evaluation.verticesPerInstance;
    push.pairs = firstPair(evaluation.rate);
    push.patchesPerGroup = 1;
    push.uvSets = tables.uvSets;
    push.faceUvs = tables.faceUvs ? 1 : 0;
    return push;
}

/// Attributes that are asked for and that the tables have, beside the first UV set and the color.
uint32_t outputsOf(const ProgramBuilder& builder) {
    return builder.tables.attributeOutputs() & builder.needs.attributeOutputs;
}

uint32_t cornerNormals(const ProgramBuilder& builder) {
    return builder.tables.cornerNormals ? 1 : 0;
}

/// Patches a workgroup takes in the wide mapping: the count that leaves the fewest lanes idle.
uint32_t patchesPerGroup(uint32_t samples, uint32_t localSize) {
    uint32_t best = 1;
    double bestUse = 0.0;
    for (uint32_t n = 1; n <= kMaxPatchesPerGroup; ++n) {
        const uint32_t rounds = (n * samples + localSize - 1) / localSize;
        const double use = static_cast<double>(n * samples) / (rounds * localSize);
        if (use > bestUse + 0.02) { // a larger group must be worth its shared memory
            best = n;
            bestUse = use;
        }
        if (n * samples >= 4 * localSize) {
            break;
        }
    }
    return best;
}

/// Adds a range of patches to a vertex pass. `side`: samples of a row of theirs.
void addEvaluate(ProgramBuilder& builder, const ProgramBuilder::VertexPass& pass, size_t range,
                 const gpu::Kernel& kernel, uint32_t samples, uint32_t side) {
    const PatchRange& from = builder.tables.ranges[range];
    const gpu::Mapping& mapping = builder.device.mapping;
    const PatchClassRow& row = rowOf(from.patchClass);
    SurfacePush push = pushFor(builder, from.section);
    push.samples = samples;
    push.firstPatch = from.firstPatch;
    push.firstVertex = builder.evaluation.firstVertices[range];
    DispatchSize size = builder.lanes(push.count);
    if (mapping.wide) {
        push.patchesPerGroup =
            row.isBicubic() ? std::min(mapping.localSize / side, SUPPLE_WIDE_ELEMENTS(pass.format) / row.netElements)
                            : patchesPerGroup(samples, mapping.localSize);
        size.perGroup = push.patchesPerGroup;
    }
    builder.add(*pass.steps, SetKind::evaluate, kernel, size, push);
}

/// The kernel for any rate that is set later, and that of the rate the group begins with, where one of its own pays.
gpu::Kernel evaluateKernel(ProgramBuilder& builder, PatchClass patchClass, uint32_t format) {
    const auto make = [&](uint32_t rate) {
        return builder.kernel(SetKind::evaluate, rowOf(patchClass).evaluate,
                              {{kKindConstant, static_cast<uint32_t>(patchClass)},
                               {kVertexFormatConstant, format},
                               {kCornerNormalsConstant, cornerNormals(builder)},
                               {kRateConstant, rate}},
                              atRate(std::string("supple evaluate, ") + className(patchClass), rate));
    };
    const gpu::Kernel any = make(0), own = ownRatePays(builder, patchClass) && format != kVertexPosition
                                               ? make(builder.needs.rate)
                                               : any;
    return builder.evaluation.rate == builder.needs.rate ? own : any;
}

void addAttributes(ProgramBuilder& builder, size_t range, const gpu::Kernel& kernel, uint32_t samples) {
    const PatchRange& from = builder.tables.ranges[range];
    SurfacePush push = pushFor(builder, {from.attributes, from.section.count * samples});
    push.samples = samples;
    push.firstVertex = builder.evaluation.firstVertices[range];
    builder.add(builder.program.attributes, SetKind::attributes, kernel, builder.lanes(push.count), push);
}

void addPatch(ProgramBuilder& builder, const PatchRange& range) {
    const gpu::Kernel kernel = builder.kernel(
        SetKind::construct, rowOf(range.patchClass).patch,
        {{kKindConstant, static_cast<uint32_t>(range.patchClass)}, {kCornerNormalsConstant, cornerNormals(builder)}},
        std::string("supple patch, ") + className(range.patchClass));
    SurfacePush push = pushFor(builder, range.section);
    push.firstPatch = range.firstPatch;
    builder.add(builder.program.patch, SetKind::construct, kernel, builder.lanes(push.count), push);
}

} // namespace

gpu::Kernel ProgramBuilder::kernel(SetKind sets, Kernel kernel, std::span<const gpu::Constant> constants,
                                   const std::string& name) {
    if (!status_) {
        return {};
    }
    const Result<gpu::Kernel> made =
        pipelines_.get(layouts_[static_cast<size_t>(sets)], shaders_[kernel], constants, name.c_str());
    if (!made) {
        status_ = made.error();
        return {};
    }
    return *made;
}

std::vector<ProgramBuilder::VertexPass> ProgramBuilder::vertexPasses() {
    std::vector<VertexPass> passes{{needs.vertexFormat, &program.evaluate}};
    if (needs.motion) {
        passes.push_back({kVertexPosition, &program.motion});
    }
    return passes;
}

void addConstructions(ProgramBuilder& builder) {
    for (uint32_t i = 0; i < builder.tables.constructions.size(); ++i) {
        const Construction& c = builder.tables.constructions[i];
        const gpu::Kernel kernel =
            builder.kernel(SetKind::construct, c.kernel.kernel, {{kKindConstant, c.kernel.kind}}, c.kernel.name);
        Steps& steps = c.stage == Stage::vertex ? builder.program.vertex : builder.program.assemble;
        // No facet kernel of P_m reads what another writes.
        const Order order = c.stage == Stage::assemble && !steps.empty() ? Order::disjoint : Order::free;
        builder.add(steps, SetKind::construct, kernel, builder.lanes(c.section.count), pushFor(builder, c.section), i,
                    order);
    }
}

void addRanges(ProgramBuilder& builder) {
    const Tables& tables = builder.tables;
    const bool evaluates = tables.fragments.classes.empty() && !tables.hasIndexedMesh();
    for (size_t r = 0; r < tables.ranges.size(); ++r) {
        const PatchRange& range = tables.ranges[r];
        const Domain domain = domainOf(range.patchClass);
        const uint32_t samples = sampleCount(domain, builder.evaluation.rate);
        if (builder.needs.attributes && !tables.hasIndexedMesh()) {
            const gpu::Kernel kernel =
                builder.kernel(SetKind::attributes, Kernel::evaluateAttributes,
                               {{kKindConstant, static_cast<uint32_t>(domain)}, {kOutputsConstant, outputsOf(builder)}},
                               "supple attributes");
            addAttributes(builder, r, kernel, samples);
        }
        if (builder.needs.patches) {
            addPatch(builder, range);
        }
        for (const ProgramBuilder::VertexPass& pass : builder.vertexPasses()) {
            if (evaluates) {
                addEvaluate(builder, pass, r, evaluateKernel(builder, range.patchClass, pass.format), samples,
                            builder.evaluation.rate + 1);
            }
        }
    }
}

void addRangesAtLevels(ProgramBuilder& builder) {
    for (uint32_t r = 0; r < builder.tables.ranges.size(); ++r) {
        const PatchRange& range = builder.tables.ranges[r];
        const PatchClassRow& row = rowOf(range.patchClass);
        SurfacePush push = pushFor(builder, range.section);
        push.firstPatch = range.firstPatch;
        push.run = r;
        for (const ProgramBuilder::VertexPass& pass : builder.vertexPasses()) {
            const gpu::Kernel kernel = builder.kernel(SetKind::evaluateLevels, row.atLevels,
                                                      {{kKindConstant, static_cast<uint32_t>(range.patchClass)},
                                                       {kVertexFormatConstant, pass.format},
                                                       {kCornerNormalsConstant, cornerNormals(builder)}},
                                                      std::string("supple evaluate at levels, ") + row.name);
            builder.add(*pass.steps, SetKind::evaluateLevels, kernel, builder.lanes(push.count), push, r);
        }
        if (builder.needs.attributes) {
            const gpu::Kernel kernel = builder.kernel(
                SetKind::attributes,
                row.form == lod::Form::quad ? Kernel::evaluateAttributesLevels : Kernel::evaluateAttributesLevelsRings,
                {{kKindConstant, static_cast<uint32_t>(row.domain)}, {kOutputsConstant, outputsOf(builder)}},
                std::string("supple attributes at levels, ") + row.name);
            push.table = range.attributes;
            builder.add(builder.program.attributes, SetKind::attributes, kernel, builder.lanes(push.count), push, r);
        }
    }
}

namespace {

void addEdges(ProgramBuilder& builder, const ProgramBuilder::VertexPass& pass) {
    constexpr const char* kNames[] = {"supple evaluate edges", "supple evaluate edges, perturbed",
                                      "supple evaluate edges, P_m"};
    static_assert(std::size(kNames) == kEdgeKinds);
    const uint32_t rate = ownRatePays(builder) ? builder.needs.rate : 0;
    for (const MeshTables::Edges& edges : builder.tables.mesh.edges) {
        const gpu::Kernel kernel = builder.kernel(SetKind::evaluate, Kernel::evaluateEdge,
                                                  {{kKindConstant, edges.kind},
                                                   {kVertexFormatConstant, pass.format},
                                                   {kCornerNormalsConstant, cornerNormals(builder)},
                                                   {kRateConstant, rate}},
                                                  atRate(kNames[edges.kind], rate));
        SurfacePush push = pushFor(builder, edges.section);
        push.firstVertex = builder.evaluation.firstEdgeVertex;
        const DispatchSize size = builder.lanes(push.count * (builder.device.mapping.wide ? push.rate : 1));
        builder.add(*pass.steps, SetKind::evaluate, kernel, size, push);
    }
}

void addEdgeAttributes(ProgramBuilder& builder) {
    const MeshTables& mesh = builder.tables.mesh;
    const gpu::Kernel kernel = builder.kernel(SetKind::attributes, Kernel::evaluateAttributes,
                                              {{kKindConstant, kEdgeDomain}, {kOutputsConstant, outputsOf(builder)}},
                                              "supple attributes of edges");
    SurfacePush push = pushFor(builder, {mesh.attributes.table, mesh.attributes.count * builder.evaluation.rate});
    push.ring = mesh.edges.front().section.table;
    push.firstVertex = builder.evaluation.firstEdgeVertex;
    builder.add(builder.program.attributes, SetKind::attributes, kernel, builder.lanes(push.count), push);
}

} // namespace

void addIndexedMesh(ProgramBuilder& builder) {
    const Tables& tables = builder.tables;
    // The rate of such a group stays. At low ones patches may have no sample inside.
    const auto inside = [&](size_t range) {
        return interiorCount(domainOf(tables.ranges[range].patchClass), builder.evaluation.rate);
    };
    for (const ProgramBuilder::VertexPass& pass : builder.vertexPasses()) {
        for (size_t r = 0; r < tables.ranges.size(); ++r) {
            const PatchClass patchClass = tables.ranges[r].patchClass;
            if (inside(r) == 0) {
                continue;
            }
            const uint32_t rate = ownRatePays(builder, patchClass) ? builder.needs.rate : 0;
            const gpu::Kernel kernel =
                builder.kernel(SetKind::evaluate, rowOf(patchClass).evaluate,
                               {{kKindConstant, static_cast<uint32_t>(patchClass)},
                                {kVertexFormatConstant, pass.format},
                                {kCornerNormalsConstant, cornerNormals(builder)},
                                {kInteriorConstant, VK_TRUE},
                                {kRateConstant, rate}},
                               atRate(std::string("supple evaluate inside, ") + className(patchClass), rate));
            addEvaluate(builder, pass, r, kernel, inside(r), builder.evaluation.rate - 1);
        }
        addEdges(builder, pass);
    }
    if (!builder.needs.attributes) {
        return;
    }
    for (size_t r = 0; r < tables.ranges.size(); ++r) {
        if (inside(r) > 0) {
            const gpu::Kernel kernel =
                builder.kernel(SetKind::attributes, Kernel::evaluateAttributes,
                               {{kKindConstant, static_cast<uint32_t>(domainOf(tables.ranges[r].patchClass))},
                                {kInteriorConstant, VK_TRUE},
                                {kOutputsConstant, outputsOf(builder)}},
                               "supple attributes inside");
            addAttributes(builder, r, kernel, inside(r));
        }
    }
    addEdgeAttributes(builder);
}

} // namespace supple::surface
