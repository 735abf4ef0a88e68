// The deformed cage of a piece: what a surface of some parts alone is made from.
#pragma once

#include "gpu/buffer_plan.h"
#include "runtime/deform_sets.h"
#include "runtime/instance_set.h"
#include "runtime/pass_cost.h"

namespace supple::runtime {

class GatheredCage {
public:
    /// `deform` and `piece` must outlive this. `deform` is ready to gather.
    GatheredCage(const skinning::DeformPass& deform, const AssetPiece& piece) : deform_(&deform), piece_(&piece) {}

    void plan(gpu::BufferPlan& device, uint32_t capacity);
    [[nodiscard]] Status createSets(const gpu::Device& device, const InstanceSet& instances,
                                    const InstanceListing& listing);

    [[nodiscard]] const gpu::PlannedBuffer& cages() const { return cages_; }
    /// Vertices from one instance to the next.
    [[nodiscard]] uint32_t stride() const;
    /// Context::recordWarmUp.
    void recordWarmUp(VkCommandBuffer commandBuffer) const;
    /// Behind the deform pass.
    PassCost record(VkCommandBuffer commandBuffer, const InstanceWindows& windows) const;

private:
    const skinning::DeformPass* deform_;
    const AssetPiece* piece_;
    uint32_t wholeStride_ = 0;
    gpu::PlannedBuffer cages_;
    DeformSets sets_;
};

} // namespace supple::runtime
