// The deform pass: linear blend skinning of the control cage in compute, with any number of influences a vertex.
#pragma once

#include "cage/character.h"
#include "gpu/pipeline.h"
#include "shaders/shared/deform.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::skinning {

/// Rest positions and influences in the layout of shaders/shared/deform.h; four words an element.
[[nodiscard]] std::vector<uint32_t> buildDeformTable(const cage::Cage& cage, const cage::SkinWeights& weights);

/// The pipeline of the pass. Palettes: three float4 rows a joint, instance-major (skinning::Affine). Output: float4
/// (x, y, z, 1) a cage vertex, `cageStride` vertices an instance.
class DeformPass {
public:
    [[nodiscard]] static Result<DeformPass> create(const gpu::Device& device);

    [[nodiscard]] const gpu::ComputeLayout& layout() const { return layout_; }
    /// Records one dispatch over a window of instances; `set` binds the window's buffers.
    void record(VkCommandBuffer commandBuffer, VkDescriptorSet set, const shared::DeformPush& push) const;

private:
    const gpu::Device* device_ = nullptr;
    gpu::ComputeLayout layout_;
    gpu::PipelineHandle pipeline_;
};

} // namespace supple::skinning
