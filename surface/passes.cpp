#include "surface/passes.h"

#include "shaders/blend_chart_comp.h"
#include "shaders/blend_evaluate_comp.h"
#include "shaders/blend_evaluate_comp_LEVELS.h"
#include "shaders/evaluate_attributes_comp.h"
#include "shaders/evaluate_attributes_comp_LEVELS.h"
#include "shaders/evaluate_attributes_comp_LEVELS_RINGS.h"
#include "shaders/evaluate_bicubic_comp.h"
#include "shaders/evaluate_bicubic_comp_LEVELS.h"
#include "shaders/evaluate_bicubic_comp_LEVELS_REGULAR.h"
#include "shaders/evaluate_edge_comp.h"
#include "shaders/evaluate_patch_comp.h"
#include "shaders/kernel_fragment_comp.h"
#include "shaders/kernel_isolate_comp.h"
#include "shaders/kernel_limit_comp.h"
#include "shaders/kernel_refine_comp.h"
#include "shaders/lod_edge_comp.h"
#include "shaders/lod_patch_comp.h"
#include "shaders/lod_patch_comp_BACK_FACES.h"
#include "shaders/lod_patch_comp_CHARTS.h"
#include "shaders/lod_place_comp.h"
#include "shaders/lod_solve_comp.h"
#include "shaders/pm_evaluate_comp.h"
#include "shaders/pm_evaluate_comp_LEVELS.h"
#include "shaders/pm_facet_comp.h"
#include "shaders/pm_patch_comp.h"
#include "shaders/pm_vertex_comp.h"
#include "shaders/prep_edge_comp.h"
#include "shaders/prep_vertex_comp.h"
#include "shaders/shared/kernel.h"
#include "shaders/shared/lod.h"
#include "shaders/shared/pm.h"
#include "surface/lod/tables.h"
#include "surface/shared_samples.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace supple::surface {

namespace {

static_assert(sizeof(shared::SurfacePush) <= gpu::kPushConstantBytes);
static_assert(sizeof(shared::KernelPush) <= sizeof(shared::SurfacePush));

// Specialization constants of the passes. Construction kernels have one, their kind; the others a class or domain.
constexpr uint32_t kKindConstant = gpu::kFirstPassConstant;
constexpr uint32_t kVertexFormatConstant = kKindConstant + 1;
constexpr uint32_t kCornerNormalsConstant = kKindConstant + 2;
constexpr uint32_t kInteriorConstant = kKindConstant + 5;
constexpr uint32_t kRateConstant = kKindConstant + 6;
constexpr uint32_t kOutputsConstant = kKindConstant + 7;

shared::SurfacePush pushFor(const Tables& tables, const Section& section, const Window& window,
                            const Evaluation& evaluation) {
    shared::SurfacePush push{};
    push.count = section.count;
    push.firstInstance = window.firstInstance;
    push.firstCorner = evaluation.firstCornerVertex;
    push.instanceCount = window.instanceCount;
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

/// Those of `wanted` that the tables have.
uint32_t outputsOf(const Tables& tables, uint32_t wanted) {
    return ((tables.uvSets == 2 ? shared::kOutputUvs1 : 0) | (tables.faceUvs ? shared::kOutputFaceUvs : 0)) & wanted;
}

/// Patches a workgroup takes in the wide mapping: the count that leaves the fewest lanes idle.
uint32_t patchesPerGroup(uint32_t samples, uint32_t localSize) {
    uint32_t best = 1;
    double bestUse = 0.0;
    for (uint32_t n = 1; n <= shared::kMaxPatchesPerGroup; ++n) {
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

/// The same of bicubic patches, whose rows take a lane each.
uint32_t bicubicPatchesPerGroup(uint32_t patchClass, uint32_t vertexFormat, uint32_t side, uint32_t localSize) {
    using namespace shared;
    const uint32_t elements = patchClass == kPerturbedPatch ? kWidePerturbedNetElements : kWideNetElements;
    return std::min(localSize / side, SUPPLE_WIDE_ELEMENTS(vertexFormat) / elements);
}

} // namespace

Shaders Shaders::embedded() {
    Shaders shaders;
    shaders.prepVertex = prep_vertex_comp;
    shaders.prepEdge = prep_edge_comp;
    shaders.pmVertex = pm_vertex_comp;
    shaders.pmFacet = pm_facet_comp;
    shaders.pmPatch = pm_patch_comp;
    shaders.pmEvaluate = pm_evaluate_comp;
    shaders.isolate = kernel_isolate_comp;
    shaders.blendChart = blend_chart_comp;
    shaders.blendEvaluate = blend_evaluate_comp;
    shaders.kernel = {kernel_fragment_comp, kernel_refine_comp, kernel_limit_comp};
    shaders.patch = evaluate_patch_comp;
    shaders.bicubic = evaluate_bicubic_comp;
    shaders.edge = evaluate_edge_comp;
    shaders.attributes = evaluate_attributes_comp;
    shaders.lod = {lod_edge_comp,         lod_patch_comp, lod_patch_comp_BACK_FACES,
                   lod_patch_comp_CHARTS, lod_solve_comp, lod_place_comp};
    shaders.levels = {
        pm_evaluate_comp_LEVELS,      blend_evaluate_comp_LEVELS,      evaluate_bicubic_comp_LEVELS_REGULAR,
        evaluate_bicubic_comp_LEVELS, evaluate_attributes_comp_LEVELS, evaluate_attributes_comp_LEVELS_RINGS};
    return shaders;
}

uint64_t Evaluation::layOut(const Tables& tables, uint64_t first) {
    uint64_t vertices = first;
    firstVertices.clear();
    const bool shares = tables.sharesSamples();
    for (const PatchRange& range : tables.ranges) {
        const Domain domain = domainOf(range.patchClass);
        firstVertices.push_back(static_cast<uint32_t>(vertices));
        vertices += uint64_t{shares ? interiorCount(domain, rate) : sampleCount(domain, rate)} * range.section.count;
    }
    if (shares) {
        firstEdgeVertex = static_cast<uint32_t>(vertices);
        vertices += uint64_t{rate - 1} * tables.shared.edgeCount;
        firstCornerVertex = static_cast<uint32_t>(vertices);
        vertices += tables.shared.cornerCount;
    }
    return vertices;
}

Result<Passes> Passes::create(const gpu::Device& device, const Shaders& shaders) {
    using namespace shared;
    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    constexpr VkDescriptorType kTexels = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    const gpu::Binding bindings[] = {
        {kTableBinding, kStorage},     {kTable4TexelBinding, kTexels},   {kTable1TexelBinding, kTexels},
        {kCageBinding, kStorage},      {kCageTexelBinding, kTexels},     {kPoolBinding, kStorage},
        {kPoolTexelBinding, kTexels},  {kSurfaceBinding, kStorage},      {kPatchCoefficientBinding, kStorage},
        {kAttributeBinding, kStorage}, {kUv1Binding, kStorage},          {kPairBinding, kStorage},
        {kScratchBinding, kStorage},   {kScratchTexelBinding, kTexels},  {kFaceUvBinding, kStorage},
        {kInstanceBinding, kStorage},  {kInstanceTexelBinding, kTexels}, {kLodBinding, kStorage},
        {kLodTexelBinding, kTexels}};
    Passes passes;
    passes.device_ = &device;
    passes.shaders_ = shaders;
    Result<gpu::ComputeLayout> layout =
        gpu::ComputeLayout::create(device, bindings, std::max(sizeof(SurfacePush), sizeof(LodPush)), "supple surface");
    if (!layout) {
        return layout.error();
    }
    passes.layout_ = std::move(*layout);
    passes.kernel_ = kernel::Passes(device, shaders.kernel);
    passes.lod_ = lod::Passes(device, shaders.lod);
    return passes;
}

Status Passes::make(gpu::PipelineHandle& target, const gpu::Spirv& spirv, std::span<const gpu::Constant> constants,
                    const std::string& name) {
    if (target.get() != VK_NULL_HANDLE) {
        return success();
    }
    Result<gpu::PipelineHandle> pipeline =
        gpu::createComputePipeline(*device_, layout_, spirv, constants, name.c_str());
    if (!pipeline) {
        return pipeline.error();
    }
    target = std::move(*pipeline);
    return success();
}

Status Passes::makeAtRate(ByRate& kernels, uint32_t rate, const gpu::Spirv& spirv, std::vector<gpu::Constant> constants,
                          const std::string& name) {
    constants.push_back({kRateConstant, rate});
    auto own = std::find_if(kernels.begin(), kernels.end(), [&](const AtRate& k) { return k.rate == rate; });
    if (own == kernels.end()) {
        own = kernels.insert(kernels.end(), {rate, {}});
    }
    return make(own->pipeline, spirv, constants, name + (rate == 0 ? "" : ", rate " + std::to_string(rate)));
}

Status Passes::makeConstruction(Kernel kernel) {
    using namespace shared;
    struct Source {
        gpu::Spirv Shaders::*spirv;
        uint32_t kind;
        const char* name;
    };
    constexpr Source kSources[] = {
        {&Shaders::prepVertex, kRegularFan, "supple p-rep vertex, regular"},
        {&Shaders::prepVertex, kFewFan, "supple p-rep vertex"},
        {&Shaders::prepVertex, kManyFan, "supple p-rep vertex, many spokes"},
        {&Shaders::prepEdge, 0, "supple p-rep edge"},
        {&Shaders::pmVertex, kRegularFan, "supple P_m vertex, regular"},
        {&Shaders::pmVertex, kFewFan, "supple P_m vertex"},
        {&Shaders::pmVertex, kManyFan, "supple P_m vertex, many spokes"},
        {&Shaders::pmVertex, kCreasedFan, "supple P_m vertex, creased"},
        {&Shaders::pmFacet, kPolarPatch, "supple P_m facet, polar"},
        {&Shaders::pmFacet, kP3Patch, "supple P_m facet, triangle"},
        {&Shaders::pmFacet, kP4Patch, "supple P_m facet, quad"},
        {&Shaders::pmFacet, kP5Patch, "supple P_m facet, pentagon"},
        {&Shaders::isolate, 0, "supple kernel, isolate"},
        {&Shaders::isolate, 1, "supple kernel, isolate once more"},
        {&Shaders::blendChart, 0, "supple blend, chart"},
        {&Shaders::blendChart, 1, "supple blend, chart of a subdivided cage"},
    };
    static_assert(std::size(kSources) == static_cast<size_t>(Kernel::count));
    const auto index = static_cast<size_t>(kernel);
    const Source& source = kSources[index];
    return make(construction_[index], shaders_.*source.spirv, {{kKindConstant, source.kind}}, source.name);
}

Status Passes::prepare(const Tables& tables, const Needs& needs) {
    using namespace shared;
    Status status = success();
    for (size_t c = 0; status && c < tables.constructions.size(); ++c) {
        status = makeConstruction(tables.constructions[c].kernel);
    }
    std::vector<uint32_t> formats{needs.vertexFormat};
    if (needs.motion) {
        formats.push_back(kVertexPosition);
    }
    const uint32_t normals = tables.cornerNormals ? 1 : 0;
    const uint32_t outputs = outputsOf(tables, needs.attributeOutputs);
    if (status && needs.view) {
        status = lod_.prepare(layout_, tables.lod, needs.backFaces);
    }
    const bool shares = tables.sharesSamples();
    if (status && shares) {
        status = makeShared(tables, needs, formats);
    }
    for (const PatchRange& range : tables.ranges) {
        const auto patchClass = static_cast<uint32_t>(range.patchClass);
        const std::string name = className(range.patchClass);
        const bool bicubic = patchClass <= kPolarPatch;
        const bool blends = range.patchClass == PatchClass::blend || range.patchClass == PatchClass::blendSharp;
        if (needs.lod) {
            const gpu::Spirv& evaluate = blends                        ? shaders_.levels.blendEvaluate
                                         : patchClass == kRegularPatch ? shaders_.levels.regular
                                         : bicubic                     ? shaders_.levels.bicubic
                                                                       : shaders_.levels.pmEvaluate;
            for (size_t f = 0; status && f < formats.size(); ++f) {
                status = make(lodEvaluate_[formats[f]][patchClass][normals], evaluate,
                              {{kKindConstant, patchClass},
                               {kVertexFormatConstant, formats[f]},
                               {kCornerNormalsConstant, normals}},
                              "supple evaluate at levels, " + name);
            }
            if (status && needs.attributes) {
                status = make(
                    lodAttributes_[patchClass][outputs],
                    lod::formOf(range.patchClass) == lod::Form::quad ? shaders_.levels.attributes
                                                                     : shaders_.levels.ringAttributes,
                    {{kKindConstant, static_cast<uint32_t>(domainOf(range.patchClass))}, {kOutputsConstant, outputs}},
                    "supple attributes at levels, " + name);
            }
            continue;
        }
        if (status && needs.attributes && !shares) {
            const auto domain = static_cast<uint32_t>(domainOf(range.patchClass));
            status = make(attributes_[domain][outputs], shaders_.attributes,
                          {{kKindConstant, domain}, {kOutputsConstant, outputs}}, "supple attributes");
        }
        if (status && needs.patches) {
            status = make(patch_[patchClass][normals], bicubic ? shaders_.patch : shaders_.pmPatch,
                          {{kKindConstant, patchClass}, {kCornerNormalsConstant, normals}}, "supple patch, " + name);
        }
        const gpu::Spirv& evaluate = blends ? shaders_.blendEvaluate : bicubic ? shaders_.bicubic : shaders_.pmEvaluate;
        for (size_t f = 0; status && f < formats.size() && tables.fragments.classes.empty() && !shares; ++f) {
            // Any rate that is set later, and the one it begins with, where that is worth a pipeline.
            const bool own = isWorthOwn(needs.rate, patchClass) && formats[f] != kVertexPosition;
            for (const uint32_t rate : {0u, needs.rate}) {
                if (status && (rate == 0 || own)) {
                    status = makeAtRate(evaluate_[patchClass][formats[f]][normals], rate, evaluate,
                                        {{kKindConstant, patchClass},
                                         {kVertexFormatConstant, formats[f]},
                                         {kCornerNormalsConstant, normals}},
                                        "supple evaluate, " + name);
                }
            }
        }
    }
    for (size_t f = 0; status && f < formats.size() && !needs.lod; ++f) {
        status = kernel_.prepare(layout_, tables.fragments, formats[f]);
    }
    return status;
}

Status Passes::makeShared(const Tables& tables, const Needs& needs, std::span<const uint32_t> formats) {
    const uint32_t normals = tables.cornerNormals ? 1 : 0;
    // The rate of such a group stays. At low ones patches may have no sample inside.
    const auto isEmpty = [&](const PatchRange& range) {
        return interiorCount(domainOf(range.patchClass), needs.rate) == 0;
    };
    Status status = success();
    for (const uint32_t format : formats) {
        for (size_t r = 0; status && r < tables.ranges.size(); ++r) {
            if (isEmpty(tables.ranges[r])) {
                continue;
            }
            const auto patchClass = static_cast<uint32_t>(tables.ranges[r].patchClass);
            status =
                makeAtRate(inside_[patchClass][format][normals], isWorthOwn(needs.rate, patchClass) ? needs.rate : 0,
                           patchClass <= shared::kPolarPatch ? shaders_.bicubic : shaders_.pmEvaluate,
                           {{kKindConstant, patchClass},
                            {kVertexFormatConstant, format},
                            {kCornerNormalsConstant, normals},
                            {kInteriorConstant, VK_TRUE}},
                           std::string("supple evaluate inside, ") + className(tables.ranges[r].patchClass));
        }
        for (size_t e = 0; status && e < tables.shared.edges.size(); ++e) {
            const uint32_t kind = tables.shared.edges[e].kind;
            constexpr const char* kNames[] = {"supple evaluate edges", "supple evaluate edges, perturbed",
                                              "supple evaluate edges, P_m"};
            static_assert(std::size(kNames) == shared::kEdgeKinds);
            status =
                makeAtRate(edges_[kind][format][normals], isWorthOwn(needs.rate) ? needs.rate : 0, shaders_.edge,
                           {{kKindConstant, kind}, {kVertexFormatConstant, format}, {kCornerNormalsConstant, normals}},
                           kNames[kind]);
        }
    }
    if (!needs.attributes) {
        return status;
    }
    const uint32_t outputs = outputsOf(tables, needs.attributeOutputs);
    for (size_t r = 0; status && r < tables.ranges.size(); ++r) {
        if (isEmpty(tables.ranges[r])) {
            continue;
        }
        const auto domain = static_cast<uint32_t>(domainOf(tables.ranges[r].patchClass));
        status = make(insideAttributes_[domain][outputs], shaders_.attributes,
                      {{kKindConstant, domain}, {kInteriorConstant, VK_TRUE}, {kOutputsConstant, outputs}},
                      "supple attributes inside");
    }
    if (status) {
        status =
            make(insideAttributes_[shared::kEdgeDomain][outputs], shaders_.attributes,
                 {{kKindConstant, shared::kEdgeDomain}, {kOutputsConstant, outputs}}, "supple attributes of edges");
    }
    return status;
}

uint64_t Passes::groupsFor(uint64_t lanes) const {
    const uint64_t local = device_->mapping.localSize;
    return (lanes + local - 1) / local;
}

void Passes::record(VkCommandBuffer commandBuffer, VkPipeline pipeline, VkDescriptorSet set,
                    const shared::SurfacePush& push, uint64_t groups) const {
    if (push.count == 0) {
        return;
    }
    const VkPipelineLayout layout = layout_.pipelineLayout.get();
    device_->vk.CmdBindPipeline(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    device_->vk.CmdBindDescriptorSets(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
    device_->vk.CmdPushConstants(commandBuffer, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push), &push);
    gpu::dispatchLinear(*device_, commandBuffer, groups);
}

void Passes::recordStage(VkCommandBuffer commandBuffer, Stage stage, const Tables& tables, const Window& window,
                         const Evaluation& evaluation) const {
    bool first = true;
    for (size_t i = 0; i < tables.constructions.size(); ++i) {
        const Construction& c = tables.constructions[i];
        if (c.stage == stage) {
            if (stage == Stage::edge && !first) {
                // No facet kernel of P_m reads what another writes.
                gpu::disjointBarrier(*device_, commandBuffer);
            }
            first = false;
            const shared::SurfacePush push = pushFor(tables, c.section, window, evaluation);
            const VkPipeline pipeline = construction_[static_cast<size_t>(c.kernel)].get();
            if (window.arguments != VK_NULL_HANDLE && push.count > 0) {
                recordIndirect(commandBuffer, pipeline, window.set, push, window.arguments,
                               window.firstArgument + i * sizeof(VkDispatchIndirectCommand));
            } else {
                record(commandBuffer, pipeline, window.set, push, groupsFor(uint64_t{push.count} * push.instanceCount));
            }
        }
    }
}

void Passes::recordPatch(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                         const Evaluation& evaluation) const {
    for (const PatchRange& range : tables.ranges) {
        shared::SurfacePush push = pushFor(tables, range.section, window, evaluation);
        push.firstPatch = range.firstPatch;
        const auto& pipelines = patch_[static_cast<size_t>(range.patchClass)];
        record(commandBuffer, pipelines[tables.cornerNormals ? 1 : 0].get(), window.set, push,
               groupsFor(uint64_t{push.count} * push.instanceCount));
    }
}

void Passes::recordEvaluate(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                            const Evaluation& evaluation, uint32_t vertexFormat) const {
    if (!tables.fragments.classes.empty()) {
        kernel_.record(commandBuffer, tables, window, evaluation, vertexFormat);
        return;
    }
    const bool wide = device_->mapping.wide, shares = tables.sharesSamples();
    const size_t normals = tables.cornerNormals ? 1 : 0;
    const auto at = [&](const ByRate& pipelines, uint32_t rate) {
        const auto find = [&](uint32_t wanted) {
            const auto found =
                std::find_if(pipelines.begin(), pipelines.end(), [&](const AtRate& k) { return k.rate == wanted; });
            return found != pipelines.end() ? found->pipeline.get() : VK_NULL_HANDLE;
        };
        const VkPipeline own = find(rate);
        return own != VK_NULL_HANDLE ? own : find(0);
    };
    for (size_t r = 0; r < tables.ranges.size(); ++r) {
        const PatchRange& range = tables.ranges[r];
        const Domain domain = domainOf(range.patchClass);
        shared::SurfacePush push = pushFor(tables, range.section, window, evaluation);
        push.samples = shares ? interiorCount(domain, evaluation.rate) : sampleCount(domain, evaluation.rate);
        if (push.samples == 0) {
            continue;
        }
        push.firstPatch = range.firstPatch;
        push.firstVertex = evaluation.firstVertices[r];
        const auto patchClass = static_cast<uint32_t>(range.patchClass);
        const uint32_t local = device_->mapping.localSize, side = push.rate + 1 - (shares ? 2 : 0);
        push.patchesPerGroup = !wide ? 1
                               : patchClass <= shared::kPolarPatch
                                   ? bicubicPatchesPerGroup(patchClass, vertexFormat, side, local)
                                   : patchesPerGroup(push.samples, local);
        const uint64_t patches = uint64_t{push.count} * push.instanceCount;
        const uint64_t groups = wide ? (patches + push.patchesPerGroup - 1) / push.patchesPerGroup : groupsFor(patches);
        const auto& pipelines = (shares ? inside_ : evaluate_)[patchClass][vertexFormat];
        record(commandBuffer, at(pipelines[normals], push.rate), window.set, push, groups);
    }
    for (const SharedTables::Edges& edges : tables.shared.edges) {
        shared::SurfacePush push = pushFor(tables, edges.section, window, evaluation);
        push.firstVertex = evaluation.firstEdgeVertex;
        const uint64_t lanes = uint64_t{push.count} * push.instanceCount * (wide ? push.rate : 1);
        record(commandBuffer, at(edges_[edges.kind][vertexFormat][normals], push.rate), window.set, push,
               groupsFor(lanes));
    }
}

void Passes::recordAttributes(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                              const Evaluation& evaluation) const {
    const bool shares = tables.sharesSamples();
    const uint32_t outputs = outputsOf(tables, evaluation.attributeOutputs);
    for (size_t r = 0; r < tables.ranges.size(); ++r) {
        const PatchRange& range = tables.ranges[r];
        const Domain domain = domainOf(range.patchClass);
        const uint32_t samples = shares ? interiorCount(domain, evaluation.rate) : sampleCount(domain, evaluation.rate);
        const Section section{range.attributes, range.section.count * samples};
        shared::SurfacePush push = pushFor(tables, section, window, evaluation);
        push.samples = samples;
        push.firstVertex = evaluation.firstVertices[r];
        const auto& pipelines = shares ? insideAttributes_.data() : attributes_.data();
        record(commandBuffer, pipelines[static_cast<size_t>(domain)][outputs].get(), window.set, push,
               groupsFor(push.count));
    }
    if (shares) {
        const Section section{tables.shared.attributes.table, tables.shared.attributes.count * evaluation.rate};
        shared::SurfacePush push = pushFor(tables, section, window, evaluation);
        push.ring = tables.shared.edges.front().section.table;
        push.firstVertex = evaluation.firstEdgeVertex;
        record(commandBuffer, insideAttributes_[shared::kEdgeDomain][outputs].get(), window.set, push,
               groupsFor(push.count));
    }
}

void Passes::recordIndirect(VkCommandBuffer commandBuffer, VkPipeline pipeline, VkDescriptorSet set,
                            const shared::SurfacePush& push, VkBuffer arguments, VkDeviceSize offset) const {
    const VkPipelineLayout layout = layout_.pipelineLayout.get();
    device_->vk.CmdBindPipeline(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    device_->vk.CmdBindDescriptorSets(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
    device_->vk.CmdPushConstants(commandBuffer, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push), &push);
    device_->vk.CmdDispatchIndirect(commandBuffer, arguments, offset);
}

void Passes::recordLod(VkCommandBuffer commandBuffer, VkPipeline pipeline, const LodWindow& window,
                       const shared::SurfacePush& push) const {
    recordIndirect(commandBuffer, pipeline, window.set, push, window.view,
                   sizeof(uint32_t) * (shared::kLodDispatches + VkDeviceSize{8} * push.dispatch));
}

void Passes::recordLodEvaluate(VkCommandBuffer commandBuffer, const Tables& tables, const LodWindow& window,
                               const Evaluation& evaluation, uint32_t vertexFormat) const {
    for (size_t r = 0; r < tables.ranges.size(); ++r) {
        const PatchRange& range = tables.ranges[r];
        shared::SurfacePush push = pushFor(tables, range.section, {window.set, 0, 0}, evaluation);
        push.firstPatch = range.firstPatch;
        push.firstSlot = window.firstSlot;
        push.dispatch = window.firstDispatch + static_cast<uint32_t>(r);
        const auto& pipelines = lodEvaluate_[vertexFormat][static_cast<size_t>(range.patchClass)];
        recordLod(commandBuffer, pipelines[tables.cornerNormals ? 1 : 0].get(), window, push);
    }
}

void Passes::recordLodAttributes(VkCommandBuffer commandBuffer, const Tables& tables, const LodWindow& window,
                                 const Evaluation& evaluation) const {
    const uint32_t outputs = outputsOf(tables, evaluation.attributeOutputs);
    for (size_t r = 0; r < tables.ranges.size(); ++r) {
        const PatchRange& range = tables.ranges[r];
        shared::SurfacePush push =
            pushFor(tables, {range.attributes, range.section.count}, {window.set, 0, 0}, evaluation);
        push.firstPatch = range.firstPatch;
        push.firstSlot = window.firstSlot;
        push.dispatch = window.firstDispatch + static_cast<uint32_t>(r);
        recordLod(commandBuffer, lodAttributes_[static_cast<size_t>(range.patchClass)][outputs].get(), window, push);
    }
}

} // namespace supple::surface
