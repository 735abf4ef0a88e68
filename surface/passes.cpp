#include "surface/passes.h"

#include "shaders/blend_chart_comp.h"
#include "shaders/blend_evaluate_comp.h"
#include "shaders/evaluate_attributes_comp.h"
#include "shaders/evaluate_bicubic_comp.h"
#include "shaders/evaluate_patch_comp.h"
#include "shaders/kernel_fragment_comp.h"
#include "shaders/kernel_isolate_comp.h"
#include "shaders/kernel_limit_comp.h"
#include "shaders/kernel_refine_comp.h"
#include "shaders/pm_evaluate_comp.h"
#include "shaders/pm_facet_comp.h"
#include "shaders/pm_patch_comp.h"
#include "shaders/pm_vertex_comp.h"
#include "shaders/prep_edge_comp.h"
#include "shaders/prep_vertex_comp.h"
#include "shaders/shared/kernel.h"
#include "shaders/shared/pm.h"

#include <string>

namespace supple::surface {

namespace {

static_assert(sizeof(shared::SurfacePush) <= gpu::kPushConstantBytes);
static_assert(sizeof(shared::KernelPush) <= sizeof(shared::SurfacePush));

// Specialization constants of the passes. Construction kernels have one, their kind; the others a class or domain.
constexpr uint32_t kKindConstant = gpu::kFirstPassConstant;
constexpr uint32_t kVertexFormatConstant = kKindConstant + 1;
constexpr uint32_t kCornerNormalsConstant = kKindConstant + 2;

shared::SurfacePush pushFor(const Tables& tables, const Section& section, const Window& window,
                            const Evaluation& evaluation) {
    shared::SurfacePush push{};
    push.count = section.count;
    push.firstInstance = window.firstInstance;
    push.instanceCount = window.instanceCount;
    push.table = section.table;
    push.ring = tables.ring;
    push.cageStride = evaluation.cageStride;
    push.poolStride = tables.poolStride;
    push.tangents = tables.tangents;
    push.faces = tables.faces;
    push.rate = evaluation.rate;
    push.patchCount = static_cast<uint32_t>(tables.patches.size());
    push.verticesPerInstance = evaluation.verticesPerInstance;
    push.pairs = firstPair(evaluation.rate);
    push.patchesPerGroup = 1;
    push.uvSets = tables.uvSets;
    push.faceUvs = tables.faceUvs ? 1 : 0;
    return push;
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
    shaders.attributes = evaluate_attributes_comp;
    return shaders;
}

uint64_t Evaluation::layOut(const Tables& tables) {
    uint64_t vertices = 0;
    firstVertices.clear();
    for (const PatchRange& range : tables.ranges) {
        firstVertices.push_back(static_cast<uint32_t>(vertices));
        vertices += uint64_t{sampleCount(domainOf(range.patchClass), rate)} * range.section.count;
    }
    return vertices;
}

Result<Passes> Passes::create(const gpu::Device& device, const Shaders& shaders) {
    using namespace shared;
    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    constexpr VkDescriptorType kTexels = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    const gpu::Binding bindings[] = {
        {kTableBinding, kStorage},     {kTable4TexelBinding, kTexels},  {kTable1TexelBinding, kTexels},
        {kCageBinding, kStorage},      {kCageTexelBinding, kTexels},    {kPoolBinding, kStorage},
        {kPoolTexelBinding, kTexels},  {kSurfaceBinding, kStorage},     {kPatchCoefficientBinding, kStorage},
        {kAttributeBinding, kStorage}, {kUv1Binding, kStorage},         {kPairBinding, kStorage},
        {kScratchBinding, kStorage},   {kScratchTexelBinding, kTexels}, {kFaceUvBinding, kStorage},
        {kInstanceBinding, kStorage},  {kInstanceTexelBinding, kTexels}};
    Passes passes;
    passes.device_ = &device;
    Result<gpu::ComputeLayout> layout =
        gpu::ComputeLayout::create(device, bindings, sizeof(SurfacePush), "supple surface");
    if (!layout) {
        return layout.error();
    }
    passes.layout_ = std::move(*layout);

    struct Wanted {
        gpu::PipelineHandle* target;
        std::span<const uint32_t> spirv;
        std::vector<gpu::Constant> constants;
        std::string name;
    };
    std::vector<Wanted> wanted;
    const auto construction = [&](Kernel kernel, std::span<const uint32_t> spirv, uint32_t kind, const char* name) {
        wanted.push_back({&passes.construction_[static_cast<size_t>(kernel)], spirv, {{kKindConstant, kind}}, name});
    };
    construction(Kernel::prepVertexRegular, shaders.prepVertex, 1, "supple p-rep vertex, regular");
    construction(Kernel::prepVertex, shaders.prepVertex, 0, "supple p-rep vertex");
    construction(Kernel::prepEdge, shaders.prepEdge, 0, "supple p-rep edge");
    construction(Kernel::pmVertexRegular, shaders.pmVertex, kPmRegularSector, "supple P_m vertex, regular");
    construction(Kernel::pmVertex, shaders.pmVertex, kPmSmoothSector, "supple P_m vertex");
    construction(Kernel::pmVertexCreased, shaders.pmVertex, kPmCreasedSector, "supple P_m vertex, creased");
    construction(Kernel::pmPolar, shaders.pmFacet, kPolarPatch, "supple P_m facet, polar");
    construction(Kernel::pmFacet3, shaders.pmFacet, kP3Patch, "supple P_m facet, triangle");
    construction(Kernel::pmFacet4, shaders.pmFacet, kP4Patch, "supple P_m facet, quad");
    construction(Kernel::pmFacet5, shaders.pmFacet, kP5Patch, "supple P_m facet, pentagon");
    construction(Kernel::isolate, shaders.isolate, 0, "supple kernel, isolate");
    construction(Kernel::blendChart, shaders.blendChart, 0, "supple blend, chart");
    construction(Kernel::blendChartFromPool, shaders.blendChart, 1, "supple blend, chart of a subdivided cage");
    for (const uint32_t patchClass : {kBlendPatch, kBlendSharpPatch}) {
        for (uint32_t format = 0; format < kVertexFormats; ++format) {
            wanted.push_back({&passes.evaluate_[patchClass][format][0],
                              shaders.blendEvaluate,
                              {{kKindConstant, patchClass}, {kVertexFormatConstant, format}},
                              "supple evaluate, blend"});
        }
    }
    for (uint32_t domain = 0; domain < kDomainCount; ++domain) {
        wanted.push_back(
            {&passes.attributes_[domain], shaders.attributes, {{kKindConstant, domain}}, "supple attributes"});
    }
    for (uint32_t patchClass = 0; patchClass <= kP5Patch; ++patchClass) {
        const std::string name = className(static_cast<PatchClass>(patchClass));
        const bool bicubic = patchClass <= kPolarPatch;
        const uint32_t normalKinds = patchClass <= kPerturbedPatch ? 2 : 1;
        for (uint32_t normals = 0; normals < normalKinds; ++normals) {
            wanted.push_back({&passes.patch_[patchClass][normals],
                              bicubic ? shaders.patch : shaders.pmPatch,
                              {{kKindConstant, patchClass}, {kCornerNormalsConstant, normals}},
                              "supple patch, " + name});
            for (uint32_t format = 0; format < kVertexFormats; ++format) {
                wanted.push_back(
                    {&passes.evaluate_[patchClass][format][normals],
                     bicubic ? shaders.bicubic : shaders.pmEvaluate,
                     {{kKindConstant, patchClass}, {kVertexFormatConstant, format}, {kCornerNormalsConstant, normals}},
                     "supple evaluate, " + name});
            }
        }
    }
    for (const Wanted& w : wanted) {
        Result<gpu::PipelineHandle> pipeline =
            gpu::createComputePipeline(device, passes.layout_, w.spirv, w.constants, w.name.c_str());
        if (!pipeline) {
            return pipeline.error();
        }
        *w.target = std::move(*pipeline);
    }
    Result<kernel::Passes> kernelPasses = kernel::Passes::create(device, passes.layout_, shaders.kernel);
    if (!kernelPasses) {
        return kernelPasses.error();
    }
    passes.kernel_ = std::move(*kernelPasses);
    return passes;
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
    for (const Construction& c : tables.constructions) {
        if (c.stage == stage) {
            if (stage == Stage::edge && !first) {
                // No facet kernel of P_m reads what another writes. Synchronization validation cannot know: to it the
                // pool is one resource, which they all read and write.
                gpu::computeBarrier(*device_, commandBuffer);
            }
            first = false;
            const shared::SurfacePush push = pushFor(tables, c.section, window, evaluation);
            record(commandBuffer, construction_[static_cast<size_t>(c.kernel)].get(), window.set, push,
                   groupsFor(uint64_t{push.count} * push.instanceCount));
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
                            const Evaluation& evaluation) const {
    if (!tables.fragments.classes.empty()) {
        kernel_.record(commandBuffer, tables, window, evaluation);
        return;
    }
    const bool wide = device_->mapping.wide;
    for (size_t r = 0; r < tables.ranges.size(); ++r) {
        const PatchRange& range = tables.ranges[r];
        shared::SurfacePush push = pushFor(tables, range.section, window, evaluation);
        push.samples = sampleCount(domainOf(range.patchClass), evaluation.rate);
        push.firstPatch = range.firstPatch;
        push.firstVertex = evaluation.firstVertices[r];
        push.patchesPerGroup = wide ? patchesPerGroup(push.samples, device_->mapping.localSize) : 1;
        const uint64_t patches = uint64_t{push.count} * push.instanceCount;
        const uint64_t groups = wide ? (patches + push.patchesPerGroup - 1) / push.patchesPerGroup : groupsFor(patches);
        const auto& pipelines = evaluate_[static_cast<size_t>(range.patchClass)][evaluation.vertexFormat];
        record(commandBuffer, pipelines[tables.cornerNormals ? 1 : 0].get(), window.set, push, groups);
    }
}

void Passes::recordAttributes(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                              const Evaluation& evaluation) const {
    for (size_t r = 0; r < tables.ranges.size(); ++r) {
        const PatchRange& range = tables.ranges[r];
        const Domain domain = domainOf(range.patchClass);
        const uint32_t samples = sampleCount(domain, evaluation.rate);
        const Section section{range.attributes, range.section.count * samples};
        shared::SurfacePush push = pushFor(tables, section, window, evaluation);
        push.samples = samples;
        push.firstVertex = evaluation.firstVertices[r];
        record(commandBuffer, attributes_[static_cast<size_t>(domain)].get(), window.set, push, groupsFor(push.count));
    }
}

} // namespace supple::surface
