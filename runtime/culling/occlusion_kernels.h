// Occlusion: takes out of sight what lies behind a depth pyramid of the host's, of this frame's occluders or of the
// frame before (shaders/shared/bounds.h). Recorded between the bounds of a group and its list, with a barrier (compute
// to compute) on either side. Instances whose bounds reach out of the picture or behind the eye stay as they are.
#pragma once

#include "gpu/pipeline.h"
#include "gpu/pipelines.h"
#include "shaders/shared/bounds.h"

namespace supple::runtime {

class OcclusionKernels {
public:
    /// `pipelines` must outlive the pass.
    [[nodiscard]] static Result<OcclusionKernels> create(const gpu::Device& device, gpu::Pipelines& pipelines);
    /// Makes the pipeline if it is not there: on any thread, also beside recording.
    [[nodiscard]] Result<gpu::Kernel> make() const;
    /// The same for what is to be recorded.
    [[nodiscard]] Status prepare();

    /// Bounds, states and the host's list at the bindings of shaders/shared/bounds.h; the pyramid by writePyramid().
    [[nodiscard]] const gpu::ComputeLayout& layout() const { return layout_; }
    /// A view of all levels of a sampled image with one component of 32-bit floats; `imageLayout` as it is when the
    /// pass runs.
    void writePyramid(VkDescriptorSet set, VkImageView pyramid, VkImageLayout imageLayout) const;
    /// Nothing where push.instanceCount is 0.
    void record(VkCommandBuffer commandBuffer, VkDescriptorSet set, const shared::OcclusionPush& push) const;

private:
    const gpu::Device* device_ = nullptr;
    gpu::Pipelines* pipelines_ = nullptr;
    gpu::ComputeLayout layout_;
    gpu::Kernel kernel_;
};

} // namespace supple::runtime
