#include "surface/kernel/passes.h"

#include <algorithm>
#include <optional>

namespace supple::surface::kernel {

namespace {

constexpr uint32_t kLoopConstant = gpu::kFirstPassConstant;
constexpr uint32_t kVertexFormatConstant = kLoopConstant + 1;
constexpr uint32_t kSourceConstant = kLoopConstant + 2;
constexpr uint32_t kSharedPointsConstant = kLoopConstant + 2;
constexpr uint32_t kKindConstant = kLoopConstant + 3;

/// Small fragments must not hold the memory of large ones, or too few fit on a compute unit at a time.
constexpr uint32_t kBucketBytes[] = {4096, 16384, 32768, 49152};
constexpr uint32_t kPointBytes = 12;

/// Where the isolated level is read.
uint32_t netFor(uint32_t format) {
    return format == shared::kVertexPosition ? shared::kFromPastNet : shared::kFromNet;
}

/// Blocks of one step and kind from class `first` on.
Section blocksFrom(const Fragments& fragments, size_t first, size_t kind) {
    Section all = fragments.classes[first].blocks[kind];
    for (size_t c = first + 1; c < fragments.classes.size(); ++c) {
        all.count += fragments.classes[c].blocks[kind].count;
    }
    return all;
}

} // namespace

Passes::Passes(const gpu::Device& device, const Shaders& shaders) : device_(&device), shaders_(shaders) {
    if (device.mapping.wide) {
        for (const uint32_t bytes : kBucketBytes) {
            if (bytes <= device.limits.maxComputeSharedMemorySize) {
                buckets_.emplace_back().sharedPoints = bytes / kPointBytes;
            }
        }
    }
}

Status Passes::prepare(const gpu::ComputeLayout& layout, const Fragments& fragments, uint32_t format) {
    layout_ = layout.pipelineLayout.get();
    Status status = success();
    const auto make = [&](gpu::PipelineHandle& target, const gpu::Spirv& spirv, const char* name,
                          std::initializer_list<gpu::Constant> constants) {
        if (!status || target.get() != VK_NULL_HANDLE) {
            return;
        }
        Result<gpu::PipelineHandle> pipeline = gpu::createComputePipeline(*device_, layout, spirv, constants, name);
        if (!pipeline) {
            status = pipeline.error();
            return;
        }
        target = std::move(*pipeline);
    };
    const uint32_t loop = fragments.loop ? 1 : 0;
    const size_t stepwise = firstStepwise(fragments);
    for (size_t c = 0; c < stepwise; ++c) {
        Bucket& bucket = buckets_[bucketOf(fragments.classes[c].sharedPoints)];
        make(bucket.pipelines[loop][format], shaders_.fragment, "supple kernel, shared memory",
             {{kLoopConstant, loop}, {kVertexFormatConstant, format}, {kSharedPointsConstant, bucket.sharedPoints}});
    }
    if (stepwise == fragments.classes.size()) {
        return status;
    }
    // The level that is read is the isolated one in the first step, and in the limit where there is none.
    const uint32_t net = netFor(format), limitSource = fragments.steps == 0 ? net : shared::kFromScratch;
    for (uint32_t kind = 0; kind < shared::kWorkKinds; ++kind) {
        for (const uint32_t source : {shared::kFromScratch, net}) {
            if (fragments.steps > (source == shared::kFromScratch ? 1u : 0u)) {
                make(refine_[loop][source][kind], shaders_.refine, "supple kernel, refine",
                     {{kLoopConstant, loop}, {kSourceConstant, source}, {kKindConstant, kind}});
            }
        }
        make(limit_[loop][limitSource][kind][format], shaders_.limit, "supple kernel, limit",
             {{kLoopConstant, loop},
              {kVertexFormatConstant, format},
              {kSourceConstant, limitSource},
              {kKindConstant, kind}});
    }
    return status;
}

size_t Passes::bucketOf(uint32_t sharedPoints) const {
    const auto found = std::find_if(buckets_.begin(), buckets_.end(),
                                    [&](const Bucket& bucket) { return sharedPoints <= bucket.sharedPoints; });
    return static_cast<size_t>(found - buckets_.begin());
}

size_t Passes::firstStepwise(const Fragments& fragments) const {
    size_t first = 0;
    while (first < fragments.classes.size() && bucketOf(fragments.classes[first].sharedPoints) < buckets_.size()) {
        ++first;
    }
    return first;
}

uint32_t Passes::scratchStride(const Fragments& fragments) const {
    return fragments.steps > 0 && firstStepwise(fragments) < fragments.classes.size() ? fragments.scratchStride : 0;
}

Section Passes::together(const Fragments& fragments, size_t stepwise, size_t& c) const {
    const size_t bucket = bucketOf(fragments.classes[c].sharedPoints);
    Section section{fragments.classes[c].fragments.table, 0};
    for (; c < stepwise && bucketOf(fragments.classes[c].sharedPoints) == bucket; ++c) {
        section.count += fragments.classes[c].fragments.count;
    }
    return section;
}

std::vector<DispatchSize> Passes::dispatches(const Fragments& fragments) const {
    std::vector<DispatchSize> sizes;
    const size_t stepwise = firstStepwise(fragments);
    for (size_t c = 0; c < stepwise;) {
        sizes.push_back({together(fragments, stepwise, c).count, 1});
    }
    const size_t kinds = stepwise < fragments.classes.size() ? (fragments.steps + 1) * size_t{shared::kWorkKinds} : 0;
    for (size_t kind = 0; kind < kinds; ++kind) {
        const Section blocks = blocksFrom(fragments, stepwise, kind);
        if (blocks.count > 0) {
            sizes.push_back({blocks.count * shared::kBlockLanes, device_->mapping.localSize});
        }
    }
    return sizes;
}

void Passes::dispatch(VkCommandBuffer commandBuffer, VkPipeline pipeline, const Window& window, uint32_t index,
                      const shared::KernelPush& push, const DispatchSize& size) const {
    device_->vk.CmdBindPipeline(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    device_->vk.CmdBindDescriptorSets(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &window.set, 0,
                                      nullptr);
    device_->vk.CmdPushConstants(commandBuffer, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push), &push);
    if (window.arguments != VK_NULL_HANDLE) {
        device_->vk.CmdDispatchIndirect(commandBuffer, window.arguments,
                                        window.firstArgument + index * sizeof(VkDispatchIndirectCommand));
    } else {
        const uint64_t elements = uint64_t{size.elements} * push.instanceCount;
        gpu::dispatchLinear(*device_, commandBuffer, (elements + size.perGroup - 1) / size.perGroup);
    }
}

void Passes::record(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                    const Evaluation& evaluation, uint32_t format) const {
    const Fragments& fragments = tables.fragments;
    const size_t loop = fragments.loop ? 1 : 0;
    shared::KernelPush push{};
    push.firstInstance = window.firstInstance;
    push.instanceCount = window.instanceCount;
    push.poolStride = tables.poolStride;
    push.scratchStride = fragments.scratchStride;
    push.verticesPerInstance = evaluation.verticesPerInstance;
    push.samples = sampleCount(fragments.loop ? Domain::triangle : Domain::quad, evaluation.rate);
    push.firstVertex = evaluation.firstVertices.empty() ? 0 : evaluation.firstVertices.front();
    push.today = window.today ? 1 : 0;

    const size_t stepwise = firstStepwise(fragments);
    const uint32_t net = netFor(format);
    uint32_t dispatched = 0;
    push.step = fragments.steps;
    for (size_t c = 0; c < stepwise;) {
        const Bucket& bucket = buckets_[bucketOf(fragments.classes[c].sharedPoints)];
        const Section section = together(fragments, stepwise, c);
        push.records = section.table;
        push.count = section.count;
        dispatch(commandBuffer, bucket.pipelines[loop][format].get(), window, dispatched++, push, {push.count, 1});
    }
    if (stepwise == fragments.classes.size()) {
        return;
    }
    // Steps read what the one before wrote; kinds of work in a step write other runs of the scratch buffer than they
    // read.
    std::optional<size_t> recorded;
    const auto stepwiseWork = [&](const gpu::PipelineHandle& pipeline, size_t kind) {
        const Section blocks = blocksFrom(fragments, stepwise, kind);
        if (blocks.count == 0) {
            return;
        }
        const size_t step = kind / shared::kWorkKinds;
        if (recorded) {
            (*recorded == step ? gpu::disjointBarrier : gpu::computeBarrier)(*device_, commandBuffer);
        }
        recorded = step;
        push.records = blocks.table;
        push.count = blocks.count;
        dispatch(commandBuffer, pipeline.get(), window, dispatched++, push,
                 {push.count * shared::kBlockLanes, device_->mapping.localSize});
    };
    for (uint32_t step = 1; step <= fragments.steps; ++step) {
        push.step = step;
        for (uint32_t kind = 0; kind < shared::kWorkKinds; ++kind) {
            stepwiseWork(refine_[loop][step == 1 ? net : shared::kFromScratch][kind],
                         (step - 1) * shared::kWorkKinds + kind);
        }
    }
    push.step = fragments.steps;
    for (uint32_t kind = 0; kind < shared::kWorkKinds; ++kind) {
        stepwiseWork(limit_[loop][fragments.steps == 0 ? net : shared::kFromScratch][kind][format],
                     fragments.steps * shared::kWorkKinds + kind);
    }
}

} // namespace supple::surface::kernel
