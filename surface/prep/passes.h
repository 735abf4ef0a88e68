// The GPU passes of p-rep: vertex, edge, patch, evaluate, and the attributes that no pose changes.
#pragma once

#include "gpu/pipeline.h"
#include "shaders/shared/prep.h"
#include "surface/prep/scheme.h"

#include <cstdint>
#include <span>

namespace supple::surface::prep {

/// SPIR-V of the passes. The default is what was embedded at build time; tests put mutations in.
struct Shaders {
    std::span<const uint32_t> vertex, edge, patch, evaluate, attributes;
    [[nodiscard]] static Shaders embedded();
};

/// What one window of instances binds, and the numbers all its dispatches share.
struct Window {
    VkDescriptorSet set = VK_NULL_HANDLE;
    uint32_t instanceCount = 0;
};

/// What evaluation is asked for; chooses among the pipelines.
struct Evaluation {
    uint32_t rate = 8;
    uint32_t verticesPerInstance = 0;
    uint32_t cageStride = 0;
    bool vertex24 = false;
};

/// All pipelines of the scheme. Recording needs no memory and creates nothing. Between the stages the caller puts a
/// memory barrier (compute writes to compute reads): vertex | edge | patch, evaluate.
class Passes {
public:
    [[nodiscard]] static Result<Passes> create(const gpu::Device& device, const Shaders& shaders = Shaders::embedded());

    [[nodiscard]] const gpu::ComputeLayout& layout() const { return layout_; }

    void recordVertex(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                      const Evaluation& evaluation) const;
    void recordEdge(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                    const Evaluation& evaluation) const;
    void recordPatch(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                     const Evaluation& evaluation) const;
    void recordEvaluate(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                        const Evaluation& evaluation) const;
    void recordAttributes(VkCommandBuffer commandBuffer, const Tables& tables, const Window& window,
                          const Evaluation& evaluation) const;

private:
    void record(VkCommandBuffer commandBuffer, VkPipeline pipeline, VkDescriptorSet set, const shared::PrepPush& push,
                uint64_t groups) const;
    [[nodiscard]] uint64_t groupsFor(uint64_t lanes) const;

    const gpu::Device* device_ = nullptr;
    gpu::ComputeLayout layout_;
    gpu::PipelineHandle vertexRegular_, vertexOther_, edge_, attributes_;
    gpu::PipelineHandle patch_[2];          ///< by class
    gpu::PipelineHandle evaluate_[2][2][2]; ///< by class, 24-byte vertices, corner normals
};

} // namespace supple::surface::prep
