#include "surface/steps.h"

#include "shaders/shared/specialization.h"
#include "surface/construction_names.h"
#include "surface/indexed_mesh.h"
#include "surface/smooth_uvs.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace supple::surface {

namespace {

using namespace shared;

/// In the narrow mapping a rate of its own unrolls all loops over a patch's samples, and what is compiled grows with
/// it; in the wide one it makes divisions cheap, and loops of many rounds stay.
constexpr uint32_t kUnrolledRates = 8;

bool ownRatePays(const ProgramBuilder& builder) {
    return builder.device.mapping.wide || builder.options.rate <= kUnrolledRates;
}

bool ownRatePays(const ProgramBuilder& builder, PatchClass patchClass) {
    const PatchClassRow& row = rowOf(patchClass);
    return ownRatePays(builder) && (builder.device.mapping.wide ? row.ownWide : row.ownNarrow);
}

std::string atRate(const std::string& name, uint32_t rate) {
    return rate == 0 ? name : name + ", rate " + std::to_string(rate);
}

uint32_t cornerNormals(const ProgramBuilder& builder) {
    return builder.tables.cornerNormals ? 1 : 0;
}

/// Patches a workgroup takes where a lane takes a sample: the count that leaves the fewest lanes idle.
uint32_t patchesBySamples(uint32_t samples, uint32_t localSize) {
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

/// Of an indexed mesh a range evaluates the samples inside its patches alone.
uint32_t samplesOf(const ProgramBuilder& builder, PatchClass patchClass) {
    const Domain domain = domainOf(patchClass);
    const uint32_t rate = builder.evaluation.rate;
    return builder.tables.hasIndexedMesh() ? interiorCount(domain, rate) : sampleCount(domain, rate);
}

bool isAtOwnRate(const ProgramBuilder& builder) {
    return builder.evaluation.rate == builder.options.rate;
}
/// Lanes that share a patch where a lane takes as much of it as it can.
uint32_t lanesOfPatch(PatchClass patchClass) {
    const PatchClassRow& row = rowOf(patchClass);
    if (!row.hasSectors()) {
        return 1;
    }
    return row.domain == Domain::triangle ? 3 : row.domain == Domain::quad ? 4 : 5;
}
/// Wide mapping: there is a kernel at the group's own rate whose lanes take a whole patch each (evaluate/bicubic.comp,
/// loop/evaluate.comp, blend/evaluate.comp), or a sector (pm/evaluate.comp).
bool hasLanePatch(const ProgramBuilder& builder, PatchClass patchClass, uint32_t format) {
    const uint32_t rate = builder.options.rate;
    const PatchClassRow& row = rowOf(patchClass);
    return builder.device.mapping.wide &&
           (row.isBicubic() || row.hasSectors() || row.borders == Borders::splines || row.borders == Borders::charts) &&
           format == kVertex16 && rate > 0 && rate <= kMaxLanePatchRate;
}
/// It is chosen where a group that is full has work for all lanes of the device.
bool prefersLanePatch(const ProgramBuilder& builder, const PatchRange& range, uint32_t format) {
    return hasLanePatch(builder, range.patchClass, format) &&
           uint64_t{range.section.count} * lanesOfPatch(range.patchClass) * builder.options.instances >=
               builder.device.mapping.lanesToFill;
}

/// Patches a workgroup takes in the wide mapping.
uint32_t patchesPerGroup(const ProgramBuilder& builder, const PatchRange& range, uint32_t format) {
    if (isAtOwnRate(builder) && prefersLanePatch(builder, range, format)) {
        return kPatchLanes / lanesOfPatch(range.patchClass);
    }
    const PatchClassRow& row = rowOf(range.patchClass);
    const uint32_t lanes = builder.device.mapping.localSize, rate = builder.evaluation.rate;
    if (row.hasRows()) { // a lane takes one
        const uint32_t rows = builder.tables.hasIndexedMesh() ? rate - 1 : rate + 1;
        return std::min(lanes / rows, SUPPLE_WIDE_ELEMENTS(format) / row.netElements);
    }
    if (row.hasQuarters()) {
        return lanes / 4;
    }
    return patchesBySamples(samplesOf(builder, range.patchClass), lanes);
}

gpu::Kernel evaluateKernel(ProgramBuilder& builder, PatchClass patchClass, uint32_t format, uint32_t rate,
                           bool lanePatch) {
    const bool indexed = builder.tables.hasIndexedMesh();
    const bool records = builder.tables.fanRecords;
    const std::string name = (indexed   ? "supple evaluate inside, "
                              : records ? "supple evaluate fan records, "
                                        : "supple evaluate, ") +
                             std::string(className(patchClass)) +
                             (!lanePatch                      ? ""
                              : lanesOfPatch(patchClass) == 1 ? ", a lane a patch"
                                                              : ", a lane a sector");
    const PatchClassRow& row = rowOf(patchClass);
    return builder.kernel(SetKind::evaluate, records ? row.evaluateRecords : row.evaluate,
                          {{kKindConstant, static_cast<uint32_t>(patchClass)},
                           {kVertexFormatConstant, format},
                           {kCornerNormalsConstant, cornerNormals(builder)},
                           {kInteriorConstant, indexed ? VK_TRUE : VK_FALSE},
                           {kTangentsConstant, tangentsConstant(builder, format)},
                           {kRateConstant, rate},
                           {kLanePatchConstant, lanePatch ? VK_TRUE : VK_FALSE},
                           {kLocalSizeConstant, lanePatch ? kPatchLanes : builder.device.mapping.localSize}},
                          atRate(name, rate));
}

/// Makes the kernels that a group needs of a range, and returns that of the rate it has now. The rate of a group with
/// an indexed mesh stays; others have a kernel for any rate, for those that are set later. If nobody knows yet how many
/// instances there are, all that they may need are made.
gpu::Kernel evaluateKernel(ProgramBuilder& builder, const PatchRange& range, uint32_t format) {
    const PatchClass patchClass = range.patchClass;
    const bool indexed = builder.tables.hasIndexedMesh(), isUnknown = builder.options.instances == 0;
    const bool prefersLane = prefersLanePatch(builder, range, format);
    const uint32_t rate = builder.options.rate, ownRate = ownRatePays(builder, patchClass) ? rate : 0;
    gpu::Kernel any;
    if (!indexed) {
        any = evaluateKernel(builder, patchClass, format, 0, false);
    }
    gpu::Kernel own = any; // of the rate that the group begins with
    const struct {
        bool isNeeded;
        uint32_t rate;
        bool lanePatch;
    } ownRates[] = {
        {!prefersLane && (indexed || (ownRate > 0 && format != kVertexPosition)), ownRate, false},
        {prefersLane || (isUnknown && hasLanePatch(builder, patchClass, format)), rate, true},
    };
    for (const auto& kernel : ownRates) {
        if (kernel.isNeeded) {
            own = evaluateKernel(builder, patchClass, format, kernel.rate, kernel.lanePatch);
        }
    }
    return indexed || isAtOwnRate(builder) ? own : any;
}

void addEvaluate(ProgramBuilder& builder, const ProgramBuilder::VertexPass& pass, size_t range) {
    const PatchRange& from = builder.tables.ranges[range];
    const gpu::Mapping& mapping = builder.device.mapping;
    auto push = pushFor<EvaluatePush>(from.section);
    push.rate = builder.evaluation.rate;
    push.samples = samplesOf(builder, from.patchClass);
    push.firstVertex = builder.evaluation.firstVertices[range];
    push.verticesPerInstance = builder.evaluation.verticesPerInstance;
    DispatchSize size = builder.lanes(push.count);
    if (mapping.wide) {
        push.patchesPerGroup = patchesPerGroup(builder, from, pass.format);
        size.perGroup = push.patchesPerGroup;
    }
    builder.add(*pass.steps, SetKind::evaluate, evaluateKernel(builder, from, pass.format), size, push,
                static_cast<uint32_t>(range));
}

/// The kernel of a class's attributes, and its kind: linear ones are told by domains alone.
struct AttributeKernel {
    Kernel kernel = Kernel::evaluateAttributes;
    uint32_t kind = 0;
};
AttributeKernel attributeKernel(const Tables& tables, PatchClass patchClass, bool levels) {
    const PatchClassRow& row = rowOf(patchClass);
    if (tables.uvLeaves) {
        if (row.domain == Domain::triangle) {
            return {levels ? Kernel::evaluateAttributesLevelsRingsTriangles : Kernel::evaluateAttributesTriangles,
                    static_cast<uint32_t>(row.domain)};
        }
        return {levels ? Kernel::evaluateAttributesLevelsQuads : Kernel::evaluateAttributesQuads,
                static_cast<uint32_t>(row.domain)};
    }
    if (tables.uvMode == cage::UvMode::all) {
        const Kernel atLevels =
            row.hasRings() ? Kernel::evaluateAttributesLevelsRings : Kernel::evaluateAttributesLevels;
        return {levels ? atLevels : Kernel::evaluateAttributes, static_cast<uint32_t>(row.domain)};
    }
    AttributeKernel smooth{Kernel::evaluateAttributesSamples, static_cast<uint32_t>(patchClass)};
    if (row.isBicubic()) {
        smooth.kernel = levels ? Kernel::evaluateAttributesLevelsBicubic : Kernel::evaluateAttributesBicubic;
    } else if (row.hasSectors()) {
        smooth.kernel = levels ? Kernel::evaluateAttributesLevelsRingsSectors : Kernel::evaluateAttributesSectors;
    } else if (row.borders == Borders::charts) {
        smooth.kernel = levels ? Kernel::evaluateAttributesLevelsBlend : Kernel::evaluateAttributesBlend;
    }
    return smooth;
}

uint32_t semiSharpUvs(const ProgramBuilder& builder) {
    return haveSharpUvs(builder.tables) ? VK_TRUE : VK_FALSE;
}

void addAttributes(ProgramBuilder& builder, size_t range) {
    const PatchRange& from = builder.tables.ranges[range];
    const bool indexed = builder.tables.hasIndexedMesh();
    const AttributeKernel own = attributeKernel(builder.tables, from.patchClass, false);
    const gpu::Kernel kernel =
        builder.kernel(SetKind::attributes, own.kernel,
                       {{kKindConstant, own.kind},
                        {kInteriorConstant, indexed ? VK_TRUE : VK_FALSE},
                        {kSectorsConstant, rowOf(from.patchClass).hasSectors() ? VK_TRUE : VK_FALSE},
                        {kSemiSharpConstant, semiSharpUvs(builder)},
                        {kOutputsConstant, outputsOf(builder)}},
                       indexed ? "supple attributes inside" : "supple attributes");
    const uint32_t samples = samplesOf(builder, from.patchClass);
    auto push = pushFor<AttributesPush>({from.attributes, from.section.count * samples});
    push.rate = builder.evaluation.rate;
    push.samples = samples;
    push.smoothUvs = from.smoothUvs;
    push.firstVertex = builder.evaluation.firstVertices[range];
    builder.add(builder.program.attributes, SetKind::attributes, kernel, builder.lanes(push.count), push);
}

void addPatch(ProgramBuilder& builder, const PatchRange& range) {
    const PatchClassRow& row = rowOf(range.patchClass);
    const gpu::Kernel kernel = builder.kernel(
        SetKind::construct, builder.tables.fanRecords ? row.patchOfRecords : row.patch,
        {{kKindConstant, static_cast<uint32_t>(range.patchClass)}, {kCornerNormalsConstant, cornerNormals(builder)}},
        std::string("supple patch, ") + className(range.patchClass));
    auto push = pushFor<PatchPush>(range.section);
    push.firstPatch = range.firstPatch;
    builder.add(builder.program.patch, SetKind::construct, kernel, builder.lanes(push.count), push);
}

uint32_t lanesOfEdge(const ProgramBuilder& builder, Kernel which) {
    if (!builder.device.mapping.wide) {
        return 1;
    }
    // A lane takes half of an irregular quad's side (shaders/catmull_clark/edge.comp), else a sample.
    return which == Kernel::catmullClarkEdge ? 2 : builder.evaluation.rate;
}

void addEdges(ProgramBuilder& builder, const ProgramBuilder::VertexPass& pass) {
    constexpr std::pair<Kernel, const char*> kKinds[] = {{Kernel::evaluateEdge, "supple evaluate edges"},
                                                         {Kernel::evaluateEdge, "supple evaluate edges, perturbed"},
                                                         {Kernel::evaluateEdge, "supple evaluate edges, P_m"},
                                                         {Kernel::catmullClarkEdge, "supple evaluate edges, irregular"},
                                                         {Kernel::loopEdge, "supple evaluate edges, Loop"},
                                                         {Kernel::loopEdge, "supple evaluate edges, irregular Loop"},
                                                         {Kernel::loopEdge, "supple evaluate edges, sharp Loop"}};
    static_assert(std::size(kKinds) == kEdgeKinds);
    const uint32_t rate = ownRatePays(builder) ? builder.options.rate : 0;
    for (const MeshTables::Edges& edges : builder.tables.mesh.edges) {
        const auto [which, name] = kKinds[edges.kind];
        const gpu::Kernel kernel = builder.kernel(SetKind::evaluate, which,
                                                  {{kKindConstant, edges.kind},
                                                   {kVertexFormatConstant, pass.format},
                                                   {kCornerNormalsConstant, cornerNormals(builder)},
                                                   {kTangentsConstant, tangentsConstant(builder, pass.format)},
                                                   {kRateConstant, rate}},
                                                  atRate(name, rate));
        auto push = pushFor<EdgePush>(edges.section);
        push.rate = builder.evaluation.rate;
        push.firstVertex = builder.evaluation.firstEdgeVertex;
        push.firstCorner = builder.evaluation.firstCornerVertex;
        push.verticesPerInstance = builder.evaluation.verticesPerInstance;
        const DispatchSize size = builder.lanes(push.count * lanesOfEdge(builder, which));
        builder.add(*pass.steps, SetKind::evaluate, kernel, size, push);
    }
}

void addEdgeAttributes(ProgramBuilder& builder) {
    const MeshTables& mesh = builder.tables.mesh;
    const bool triangles = domainOf(builder.tables.ranges.front().patchClass) == Domain::triangle;
    const Kernel leaves = triangles ? Kernel::evaluateAttributesTriangles : Kernel::evaluateAttributesQuads;
    const Kernel which = builder.tables.uvLeaves ? leaves : Kernel::evaluateAttributes;
    const gpu::Kernel kernel = builder.kernel(SetKind::attributes, which,
                                              {{kKindConstant, kEdgeDomain},
                                               {kSemiSharpConstant, semiSharpUvs(builder)},
                                               {kOutputsConstant, outputsOf(builder)}},
                                              "supple attributes of edges");
    auto push = pushFor<AttributesPush>({mesh.attributes.table, mesh.attributes.count * builder.evaluation.rate});
    push.rate = builder.evaluation.rate;
    push.edges = mesh.edges.front().section.table;
    push.firstVertex = builder.evaluation.firstEdgeVertex;
    push.firstCorner = builder.evaluation.firstCornerVertex;
    builder.add(builder.program.attributes, SetKind::attributes, kernel, builder.lanes(push.count), push);
}

} // namespace

uint32_t tangentsConstant(const ProgramBuilder& builder, uint32_t format) {
    return builder.options.tangents && format != kVertexPosition ? VK_TRUE : VK_FALSE;
}

uint32_t outputsOf(const ProgramBuilder& builder) {
    return (builder.tables.attributeOutputs() & builder.options.attributeOutputs) |
           (builder.tables.mapFrames ? kOutputMapFrames : 0) | (builder.tables.colors ? kOutputColors : 0);
}

gpu::Kernel ProgramBuilder::kernel(SetKind sets, Kernel which, std::initializer_list<gpu::Constant> constants,
                                   const std::string& name) {
    return pipelines_.get(layouts_[static_cast<size_t>(sets)], shaders_[which],
                          std::span(constants.begin(), constants.size()), name.c_str());
}

std::vector<ProgramBuilder::VertexPass> ProgramBuilder::vertexPasses() {
    std::vector<VertexPass> passes;
    if (options.vertices) {
        passes.push_back({options.vertexFormat, &program.evaluate});
    }
    if (options.motion) {
        passes.push_back({kVertexPosition, &program.motion});
    }
    return passes;
}

void addConstructions(ProgramBuilder& builder) {
    for (uint32_t i = 0; i < builder.tables.constructions.size(); ++i) {
        const Construction& c = builder.tables.constructions[i];
        if (c.stage == Stage::deepen) { // lod::addSteps()
            continue;
        }
        const gpu::Kernel kernel = builder.kernel(SetKind::construct, c.kernel.kernel, {{kKindConstant, c.kernel.kind}},
                                                  constructionName(c.kernel));
        Steps& steps = c.stage == Stage::vertex ? builder.program.vertex : builder.program.assemble;
        // No facet kernel of P_m reads what another writes.
        const Order beside = c.stage == Stage::assemble && !steps.empty() ? Order::disjoint : Order::free;
        const Order order = c.readsPool ? Order::after : beside;
        auto push = pushFor<ConstructPush>(c.section);
        push.from = c.from;
        push.to = c.to;
        builder.add(steps, SetKind::construct, kernel, builder.lanes(c.section.count), push, i, order);
    }
}

void addRanges(ProgramBuilder& builder) {
    const Tables& tables = builder.tables;
    for (size_t r = 0; r < tables.ranges.size(); ++r) {
        if (builder.options.patches) {
            addPatch(builder, tables.ranges[r]);
        }
        if (samplesOf(builder, tables.ranges[r].patchClass) == 0) {
            continue; // at low rates patches of an indexed mesh may have no sample inside
        }
        if (builder.options.attributes) {
            addAttributes(builder, r);
        }
        for (const ProgramBuilder::VertexPass& pass : builder.vertexPasses()) {
            if (tables.fragments.classes.empty()) {
                addEvaluate(builder, pass, r);
            }
        }
    }
    if (!tables.hasIndexedMesh()) {
        return;
    }
    for (const ProgramBuilder::VertexPass& pass : builder.vertexPasses()) {
        addEdges(builder, pass);
    }
    if (builder.options.attributes) {
        addEdgeAttributes(builder);
    }
}

void addRangesAtLevels(ProgramBuilder& builder) {
    const Tables& tables = builder.tables;
    for (uint32_t r = 0; r < tables.ranges.size(); ++r) {
        const PatchRange& range = tables.ranges[r];
        const PatchClassRow& row = rowOf(range.patchClass);
        const uint32_t lines = builder.device.mapping.wide && hasLines(range.patchClass) ? VK_TRUE : VK_FALSE;
        auto push = pushFor<LevelsPush>(range.section);
        push.firstPatch = range.firstPatch;
        push.run = r;
        push.runs = builder.options.viewRuns;
        push.vertices = builder.evaluation.verticesPerInstance;
        for (const ProgramBuilder::VertexPass& pass : builder.vertexPasses()) {
            const gpu::Kernel kernel = builder.kernel(SetKind::evaluateLevels, row.atLevels,
                                                      {{kKindConstant, static_cast<uint32_t>(range.patchClass)},
                                                       {kVertexFormatConstant, pass.format},
                                                       {kTangentsConstant, tangentsConstant(builder, pass.format)},
                                                       {kCornerNormalsConstant, cornerNormals(builder)},
                                                       {kLinesConstant, lines}},
                                                      std::string("supple evaluate at levels, ") + row.name);
            builder.add(*pass.steps, SetKind::evaluateLevels, kernel, builder.lanes(push.count), push, r);
        }
        if (builder.options.attributes) {
            const AttributeKernel own = attributeKernel(builder.tables, range.patchClass, true);
            const gpu::Kernel kernel = builder.kernel(SetKind::attributes, own.kernel,
                                                      {{kKindConstant, own.kind},
                                                       {kSemiSharpConstant, semiSharpUvs(builder)},
                                                       {kLinesConstant, lines},
                                                       {kOutputsConstant, outputsOf(builder)}},
                                                      std::string("supple attributes at levels, ") + row.name);
            push.table = range.attributes;
            push.smoothUvs = range.smoothUvs;
            builder.add(builder.program.attributes, SetKind::attributes, kernel, builder.lanes(push.count), push, r);
        }
    }
}

} // namespace supple::surface
