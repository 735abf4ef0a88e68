// N instances of one asset: their poses on the CPU, their buffers and descriptor sets on the device.
#pragma once

#include "base/result.h"
#include "gpu/memory.h"
#include "gpu/static_buffers.h"
#include "runtime/asset.h"
#include "skinning/deform_pass.h"
#include "skinning/pose.h"
#include "supple/supple.h"
#include "surface/passes.h"

#include <glm/glm.hpp>
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
    [[nodiscard]] uint32_t jointCount() const { return jointCount_; }
    [[nodiscard]] const Asset& asset() const { return *asset_; }
    [[nodiscard]] const surface::Tables& tables() const { return scheme_->tables; }
    [[nodiscard]] const SuppleGroupOutput& output() const { return output_; }

    void setBindPose(uint32_t instance);
    void setClipPose(uint32_t instance, uint32_t clip, double time);
    /// jointCount() column-major model-space matrices.
    void setMatrixPose(uint32_t instance, const float* jointMatrices);
    void setTransform(uint32_t instance, const glm::mat4& transform);

    // The passes of a frame, each recorded without barriers; runtime/frame.cpp puts them in order.
    struct PassCost {
        uint64_t points = 0;
        uint64_t bytes = 0;
    };
    /// Static tables, first-use clears and this frame's palettes.
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
    uint32_t jointCount_ = 0;
    uint32_t vertexCount_ = 0; ///< surface vertices an instance, without padding
    surface::Evaluation evaluation_;

    std::vector<skinning::Affine> palettes_; ///< posed, not yet placed: jointCount_ an instance
    std::vector<glm::mat4> transforms_;      ///< one an instance
    std::vector<glm::mat4> scratch_;         ///< node transforms while posing

    gpu::BufferSet buffers_;    ///< see the enumeration in group.cpp
    gpu::BufferSet staging_;    ///< palettes, one run a frame in flight
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
    bool cleared_ = false;
    bool attributesPending_ = false;
    uint64_t lastRecordedFrame_ = 0;
};

} // namespace supple::runtime
