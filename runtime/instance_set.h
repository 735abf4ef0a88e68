// The instances of a group: their slots, poses and deformed cages.
#pragma once

#include "gpu/buffer_plan.h"
#include "runtime/asset.h"
#include "runtime/change_staging.h"
#include "runtime/culling/visibility.h"
#include "runtime/deform_sets.h"
#include "runtime/instance_slots.h"
#include "runtime/instance_windows.h"
#include "runtime/pose_source.h"
#include "runtime/transfers.h"
#include "skinning/deform_pass.h"

#include <memory>
#include <vector>

namespace supple::runtime {

/// What the surface passes bind of an instance; it decides how many instances fit a window.
struct BoundBytes {
    VkDeviceSize texels = 0;  ///< of the largest buffer that is read as texels
    VkDeviceSize storage = 0; ///< of the largest buffer that is only written
};

class InstanceSet {
public:
    struct Desc {
        const gpu::Device* device = nullptr;
        skinning::DeformPass* deform = nullptr;
        skinning::PosePass* pose = nullptr; ///< null unless instances play on the device
        Asset* asset = nullptr;             ///< must outlive the set
        SupplePoseSource source = SUPPLE_POSES_SET;
        skinning::SkinningMode mode = skinning::SkinningMode::linear;
        uint32_t capacity = 0;
        uint32_t firstGeneration = 1;
        uint32_t framesInFlight = 2;
        bool handsOver = false; ///< to another queue family: lists are written anew in every frame
        uint32_t lists = 2;     ///< that all lists of instances that passes read have `capacity` entries for
        std::vector<PartPatches> partPatches; ///< of every part
        bool listsParts = false;              ///< the host lists the instances of every part
        BoundBytes surface;
    };
    /// Prepares the pipelines and lays out the windows.
    [[nodiscard]] static Result<std::unique_ptr<InstanceSet>> create(const Desc& desc);
    void plan(gpu::BufferPlan& device, gpu::BufferPlan& staging);
    /// When the plans are carried out.
    [[nodiscard]] Status createSets();

    [[nodiscard]] InstanceSlots& slots() { return slots_; }
    [[nodiscard]] const InstanceSlots& slots() const { return slots_; }
    [[nodiscard]] SupplePoseSource source() const { return desc_.source; }
    [[nodiscard]] PoseSource& poses() { return *poses_; }
    [[nodiscard]] const PoseSource& poses() const { return *poses_; }
    [[nodiscard]] const InstanceWindows& windows() const { return windows_; }
    /// Cage vertices from one instance to the next.
    [[nodiscard]] static uint32_t cageStrideOf(uint32_t cageVertices);

    [[nodiscard]] uint32_t cageStride() const { return cageStride_; }
    [[nodiscard]] const gpu::PlannedBuffer& cages() const { return cages_; }
    [[nodiscard]] const gpu::PlannedBuffer& list() const { return list_; }
    /// Of the list, what passes read: capacity entries of all instances, then as many by window.
    [[nodiscard]] VkDeviceSize passListBytes() const { return 2 * VkDeviceSize{desc_.capacity} * sizeof(uint32_t); }
    [[nodiscard]] gpu::MemoryUse memoryUse() const { return poses_->memoryUse(); } ///< beside the planned buffers
    /// Context::recordWarmUp.
    void recordWarmUp(VkCommandBuffer commandBuffer) const;
    void fill(SuppleGroupInfo& output) const;
    void addTransfers(Transfers& transfers) const;

    /// Whether instances have come, gone or changed since the last list.
    [[nodiscard]] bool changed() const { return slots_.changed(); }
    /// This frame's poses and, if it has changed, the list of instances.
    PassCost recordUpload(VkCommandBuffer commandBuffer, uint64_t frame, Visibility& visibility);
    PassCost recordDeform(VkCommandBuffer commandBuffer) const;
    void cancelFrame(uint64_t frame) { poses_->cancelUpload(frame); }

private:
    [[nodiscard]] Status layOutWindows();

    Desc desc_;
    skinning::PoseLayout layout_;
    InstanceSlots slots_;
    InstanceWindows windows_;
    std::unique_ptr<PoseSource> poses_;
    uint32_t cageStride_ = 0;

    gpu::PlannedBuffer palettes_, cages_, list_;
    ChangeStaging lists_;
    DeformSets deformSets_; ///< none if the host fills the cages
};

} // namespace supple::runtime
