// Evaluation by the subdivision kernel: fragments refined and taken to the limit, in shared memory or level by level.
#pragma once

#include "gpu/pipeline.h"
#include "shaders/shared/kernel.h"
#include "surface/evaluation.h"
#include "surface/scheme.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace supple::surface::kernel {

/// GPUs: a workgroup a fragment, in shared memory; pipelines by how much they take of it. CPU devices, and fragments
/// too large for the device's shared memory: level by level through a scratch buffer, a dispatch a kind of work.
class Passes {
public:
    struct Shaders {
        gpu::Spirv fragment, refine, limit;
    };
    Passes() = default;
    Passes(const gpu::Device& device, const Shaders& shaders);

    /// Creates what is missing to record such fragments.
    [[nodiscard]] Status prepare(const gpu::ComputeLayout& layout, const Fragments& fragments, uint32_t format);

    /// Points an instance in the scratch buffer; 0 where none is needed.
    [[nodiscard]] uint32_t scratchStride(const Fragments& fragments) const;

    /// What record() dispatches, in order.
    [[nodiscard]] std::vector<DispatchSize> dispatches(const Fragments& fragments) const;
    /// Puts its own barriers between levels. Where the number of instances is known to the device alone, the window's
    /// arguments are those of dispatches().
    void record(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window, const Evaluation& evaluation,
                uint32_t vertexFormat) const;

private:
    /// The first class that goes through the scratch buffer.
    [[nodiscard]] size_t firstStepwise(const Fragments& fragments) const;
    [[nodiscard]] size_t bucketOf(uint32_t sharedPoints) const;
    /// The shared-memory form's classes from `c` on that one pipeline takes; `c` goes on to the next.
    [[nodiscard]] Section together(const Fragments& fragments, size_t stepwise, size_t& c) const;
    void dispatch(VkCommandBuffer commandBuffer, VkPipeline pipeline, const Window& window, uint32_t index,
                  const shared::KernelPush& push, const DispatchSize& size) const;

    const gpu::Device* device_ = nullptr;
    Shaders shaders_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    struct Bucket {
        uint32_t sharedPoints = 0;
        std::array<std::array<gpu::PipelineHandle, shared::kVertexFormats>, 2> pipelines; ///< by loop and vertex format
    };
    std::vector<Bucket> buckets_; ///< sharedPoints rise; empty on CPU devices
    // By loop, the level that is read, and kind of work; the limit also by vertex format.
    std::array<std::array<std::array<gpu::PipelineHandle, shared::kWorkKinds>, shared::kSources>, 2> refine_;
    std::array<std::array<std::array<std::array<gpu::PipelineHandle, shared::kVertexFormats>, shared::kWorkKinds>,
                          shared::kSources>,
               2>
        limit_;
};

} // namespace supple::surface::kernel
