// N instances of one asset: their poses on the CPU, their buffers and descriptor sets on the device.
#pragma once

#include "base/result.h"
#include "gpu/memory.h"
#include "gpu/static_buffers.h"
#include "runtime/asset.h"
#include "runtime/instance_poses.h"
#include "skinning/deform_pass.h"
#include "supple/supple.h"
#include "surface/passes.h"

#include <memory>
#include <vector>

namespace supple::runtime {

/// What the group borrows from its context.
struct GroupShared {
    const gpu::Device* device = nullptr;
    const skinning::DeformPass* deform = nullptr;
    const surface::Passes* surface = nullptr;
    VkBuffer pairs = VK_NULL_HANDLE;
    VkDeviceSize pairBytes = 0;
    uint32_t framesInFlight = 2;
};

class Group {
public:
    [[nodiscard]] static Result<std::shared_ptr<Group>> create(const GroupShared& shared, std::shared_ptr<Asset> asset,
                                                               const SuppleGroupDesc& desc);

    [[nodiscard]] uint32_t instanceCount() const { return instanceCount_; }
    [[nodiscard]] const Asset& asset() const { return *asset_; }
    [[nodiscard]] const surface::Tables& tables() const { return scheme_->tables; }
    [[nodiscard]] const SuppleGroupOutput& output() const { return output_; }
    /// What of the description was not taken as it stands, one line each.
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

    [[nodiscard]] InstancePoses& poses() { return poses_; }

    // The passes of a frame, each recorded without barriers; runtime/frame.cpp puts them in order.
    struct PassCost {
        uint64_t points = 0;
        uint64_t bytes = 0;
    };
    /// Static tables, first-use clears and this frame's poses.
    [[nodiscard]] Result<PassCost> recordUpload(VkCommandBuffer commandBuffer, uint64_t frame);
    PassCost recordAttributes(VkCommandBuffer commandBuffer); ///< nothing after the first time
    [[nodiscard]] bool attributesPending() const { return attributesPending_; }
    PassCost recordDeform(VkCommandBuffer commandBuffer) const;
    PassCost recordStage(VkCommandBuffer commandBuffer, surface::Stage stage) const;
    PassCost recordPatch(VkCommandBuffer commandBuffer) const;
    PassCost recordEvaluate(VkCommandBuffer commandBuffer) const;
    [[nodiscard]] bool writesPatches() const { return output_.patchCoefficients.buffer != VK_NULL_HANDLE; }

    [[nodiscard]] uint64_t lastRecordedFrame() const { return lastRecordedFrame_; }
    void releaseStaging(uint64_t completedFrame);

private:
    Status createBuffers(const SuppleGroupDesc& desc);
    Status createSets();
    void fillOutput(const SuppleGroupDesc& desc);

    GroupShared shared_;
    std::shared_ptr<Asset> asset_;
    std::shared_ptr<SchemeTables> scheme_;
    uint32_t instanceCount_ = 0;
    uint32_t vertexCount_ = 0; ///< surface vertices an instance, without padding
    surface::Evaluation evaluation_;

    InstancePoses poses_;

    gpu::BufferSet buffers_;    ///< see the enumeration in group.cpp
    gpu::BufferSet staging_;    ///< poses, one run a frame in flight
    gpu::StaticBuffers static_; ///< grid indices, indirect arguments
    gpu::DescriptorPoolHandle deformPool_, surfacePool_;
    std::vector<gpu::BufferViewHandle> views_;
    struct DeformWindow {
        VkDescriptorSet set = VK_NULL_HANDLE;
        uint32_t instanceCount = 0;
    };
    std::vector<DeformWindow> deformWindows_;
    std::vector<surface::Window> surfaceWindows_;
    SuppleGroupOutput output_{};
    std::vector<SuppleDrawRange> drawRanges_; ///< what output_ points to
    std::vector<std::string> notes_;
    bool cleared_ = false;
    bool attributesPending_ = false;
    uint64_t lastRecordedFrame_ = 0;
};

} // namespace supple::runtime
