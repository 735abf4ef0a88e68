#include "surface/prep/passes.h"

#include "shaders/evaluate_attributes_comp.h"
#include "shaders/prep_edge_comp.h"
#include "shaders/prep_evaluate_comp.h"
#include "shaders/prep_patch_comp.h"
#include "shaders/prep_vertex_comp.h"
#include "surface/grid.h"

#include <algorithm>

namespace supple::surface::prep {

namespace {

static_assert(sizeof(shared::PrepPush) <= gpu::kPushConstantBytes);

// Specialization constants of the passes (shaders/prep, shaders/evaluate/surface_vertex.glsl).
constexpr uint32_t kClassConstant = gpu::kFirstPassConstant; // kRegular, kPerturbed
constexpr uint32_t kVertex24Constant = kClassConstant + 1;
constexpr uint32_t kCornerNormalsConstant = kClassConstant + 2;

shared::PrepPush pushFor(const Tables& tables, const Section& section, const Window& window,
                         const Evaluation& evaluation) {
    shared::PrepPush push{};
    push.count = section.count;
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
    return {prep_vertex_comp, prep_edge_comp, prep_patch_comp, prep_evaluate_comp, evaluate_attributes_comp};
}

Result<Passes> Passes::create(const gpu::Device& device, const Shaders& shaders) {
    using namespace shared;
    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    constexpr VkDescriptorType kTexels = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    const gpu::Binding bindings[] = {
        {kTableBinding, kStorage},     {kTable4TexelBinding, kTexels}, {kTable1TexelBinding, kTexels},
        {kCageBinding, kStorage},      {kCageTexelBinding, kTexels},   {kPoolBinding, kStorage},
        {kPoolTexelBinding, kTexels},  {kSurfaceBinding, kStorage},    {kPatchCoefficientBinding, kStorage},
        {kAttributeBinding, kStorage}, {kPairBinding, kStorage}};
    Passes passes;
    passes.device_ = &device;
    Result<gpu::ComputeLayout> layout = gpu::ComputeLayout::create(device, bindings, sizeof(PrepPush), "supple p-rep");
    if (!layout) {
        return layout.error();
    }
    passes.layout_ = std::move(*layout);

    struct Wanted {
        gpu::PipelineHandle* target;
        std::span<const uint32_t> spirv;
        std::vector<gpu::Constant> constants;
        const char* name;
    };
    std::vector<Wanted> wanted = {
        {&passes.vertexRegular_, shaders.vertex, {{kClassConstant, VK_TRUE}}, "supple p-rep vertex, regular"},
        {&passes.vertexOther_, shaders.vertex, {{kClassConstant, VK_FALSE}}, "supple p-rep vertex"},
        {&passes.edge_, shaders.edge, {}, "supple p-rep edge"},
        {&passes.attributes_, shaders.attributes, {}, "supple p-rep attributes"},
        {&passes.patch_[0], shaders.patch, {{kClassConstant, VK_FALSE}}, "supple p-rep patch, regular"},
        {&passes.patch_[1], shaders.patch, {{kClassConstant, VK_TRUE}}, "supple p-rep patch, perturbed"},
    };
    for (uint32_t patchClass = 0; patchClass < 2; ++patchClass) {
        for (uint32_t vertex24 = 0; vertex24 < 2; ++vertex24) {
            for (uint32_t normals = 0; normals < 2; ++normals) {
                wanted.push_back(
                    {&passes.evaluate_[patchClass][vertex24][normals],
                     shaders.evaluate,
                     {{kClassConstant, patchClass}, {kVertex24Constant, vertex24}, {kCornerNormalsConstant, normals}},
                     patchClass == 0 ? "supple p-rep evaluate, regular" : "supple p-rep evaluate, perturbed"});
            }
        }
    }
    for (const Wanted& w : wanted) {
        Result<gpu::PipelineHandle> pipeline =
            gpu::createComputePipeline(device, passes.layout_, w.spirv, w.constants, w.name);
        if (!pipeline) {
            return pipeline.error();
        }
        *w.target = std::move(*pipeline);
    }
    return passes;
}

uint64_t Passes::groupsFor(uint64_t lanes) const {
    const uint64_t local = device_->mapping.localSize;
    return (lanes + local - 1) / local;
}

void Passes::record(VkCommandBuffer commandBuffer, VkPipeline pipeline, VkDescriptorSet set,
                    const shared::PrepPush& push, uint64_t groups) const {
    if (push.count == 0) {
        return;
    }
    const VkPipelineLayout layout = layout_.pipelineLayout.get();
    device_->vk.CmdBindPipeline(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    device_->vk.CmdBindDescriptorSets(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
    device_->vk.CmdPushConstants(commandBuffer, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push), &push);
    gpu::dispatchLinear(*device_, commandBuffer, groups);
}

void Passes::recordVertex(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                          const Evaluation& evaluation) const {
    for (const bool regular : {true, false}) {
        const Section& section = regular ? tables.regularVertices : tables.otherVertices;
        const shared::PrepPush push = pushFor(tables, section, window, evaluation);
        record(commandBuffer, (regular ? vertexRegular_ : vertexOther_).get(), window.set, push,
               groupsFor(uint64_t{push.count} * push.instanceCount));
    }
}

void Passes::recordEdge(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                        const Evaluation& evaluation) const {
    const shared::PrepPush push = pushFor(tables, tables.edges, window, evaluation);
    record(commandBuffer, edge_.get(), window.set, push, groupsFor(uint64_t{push.count} * push.instanceCount));
}

void Passes::recordPatch(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                         const Evaluation& evaluation) const {
    for (uint32_t patchClass = 0; patchClass < 2; ++patchClass) {
        const Section& section = patchClass == 0 ? tables.regularPatches : tables.perturbedPatches;
        shared::PrepPush push = pushFor(tables, section, window, evaluation);
        push.firstPatch = patchClass == 0 ? 0 : tables.regularPatches.count;
        record(commandBuffer, patch_[patchClass].get(), window.set, push,
               groupsFor(uint64_t{push.count} * push.instanceCount));
    }
}

void Passes::recordEvaluate(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                            const Evaluation& evaluation) const {
    const uint32_t samples = (evaluation.rate + 1) * (evaluation.rate + 1);
    const bool wide = device_->mapping.wide;
    for (uint32_t patchClass = 0; patchClass < 2; ++patchClass) {
        const Section& section = patchClass == 0 ? tables.regularPatches : tables.perturbedPatches;
        shared::PrepPush push = pushFor(tables, section, window, evaluation);
        push.firstPatch = patchClass == 0 ? 0 : tables.regularPatches.count;
        push.patchesPerGroup = wide ? patchesPerGroup(samples, device_->mapping.localSize) : 1;
        const uint64_t patches = uint64_t{push.count} * push.instanceCount;
        const uint64_t groups = wide ? (patches + push.patchesPerGroup - 1) / push.patchesPerGroup : groupsFor(patches);
        const auto& pipeline = evaluate_[patchClass][evaluation.vertex24 ? 1 : 0][tables.cornerNormals ? 1 : 0];
        record(commandBuffer, pipeline.get(), window.set, push, groups);
    }
}

void Passes::recordAttributes(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                              const Evaluation& evaluation) const {
    const uint32_t samples = (evaluation.rate + 1) * (evaluation.rate + 1);
    const Section section{tables.attributes, static_cast<uint32_t>(tables.patches.size()) * samples};
    const shared::PrepPush push = pushFor(tables, section, window, evaluation);
    record(commandBuffer, attributes_.get(), window.set, push, groupsFor(push.count));
}

} // namespace supple::surface::prep
