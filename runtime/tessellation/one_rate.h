// What tessellations have in common whose instances all have one rate: the host counts their draws.
#pragma once

#include "runtime/change_staging.h"
#include "runtime/tessellation/own_vertices.h"

namespace supple::runtime {

/// Indirect draws that the host counts: for each window that draws have, one command a draw range, for all visible
/// instances that show its part.
class HostDraws {
public:
    void plan(gpu::BufferPlan& device, gpu::BufferPlan& staging, size_t count, uint32_t framesInFlight);
    void setChanged() { changed_ = true; }
    /// `listed`: the list of instances has changed. `always`: upload though nothing has. Returns the bytes.
    VkDeviceSize recordUpload(const gpu::Device& device, VkCommandBuffer commandBuffer, bool listed, bool always,
                              std::span<const SuppleDrawRange> draws, const InstanceWindows& windows);
    /// Until the next upload there are no draws.
    void recordNone(const gpu::Device& device, VkCommandBuffer commandBuffer);
    [[nodiscard]] const gpu::PlannedBuffer& buffer() const { return buffer_; }

private:
    gpu::PlannedBuffer buffer_;
    ChangeStaging staging_;
    bool changed_ = true;
};

class OneRate : public OwnVertices {
public:
    [[nodiscard]] Status cutDraws(InstanceWindows& windows, bool byWindows) override;
    void plan(gpu::BufferPlan& device, gpu::BufferPlan& staging) override;
    [[nodiscard]] Status createSets(const SurfaceInput& input, const InstanceListing& listing,
                                    const Visibility& visibility) override;
    void fillGrid(SuppleGridOutput& output) const override;
    void addTransfers(Transfers& transfers, uint64_t frame) const override;
    void freeSets() override {
        hostDraws_.setChanged();
        OwnVertices::freeSets();
    }
    void recordNoDraws(VkCommandBuffer commandBuffer) override { hostDraws_.recordNone(*desc_.device, commandBuffer); }
    VkDeviceSize recordUpload(VkCommandBuffer commandBuffer, uint64_t frame, bool changed) override;
    PassCost recordEvaluate(surface::Round& round) const override;
    PassCost recordMotion(surface::Round& round) const override;
    [[nodiscard]] HashedPart hashedPart(uint32_t part) const override;

protected:
    using OwnVertices::OwnVertices;

    void setDraws(std::vector<SuppleDrawRange> draws);

    IndexBytes indexData_, wholeIndexData_; ///< until the index buffers are made
    HostDraws hostDraws_;
    uint32_t drawWindows_ = 1;
};

} // namespace supple::runtime
