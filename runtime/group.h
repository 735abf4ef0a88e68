// A group: instances of one asset, which instances are seen, and the surfaces that make their vertices.
#pragma once

#include "base/result.h"
#include "gpu/memory.h"
#include "runtime/asset.h"
#include "runtime/culling/culling.h"
#include "runtime/instance_set.h"
#include "runtime/surfaces.h"
#include "runtime/transfers.h"
#include "runtime/view.h"
#include "supple/supple.h"

#include <memory>

namespace supple::runtime {

/// What the group borrows from its context.
struct GroupShared {
    const gpu::Device* device = nullptr;
    skinning::DeformPass* deform = nullptr;
    skinning::PosePass* pose = nullptr; ///< for groups that play on the device
    surface::Passes* surface = nullptr;
    const gpu::StaticBuffers* pairs = nullptr; ///< of parameters
    BoundsPass* bounds = nullptr;              ///< for groups of views
    const OcclusionPass* occlusion = nullptr;  ///< for groups of views with occlusion
    std::shared_ptr<View> view;                ///< of the description
    uint32_t framesInFlight = 2;
    uint32_t firstGeneration = 1; ///< of the instances
    bool handsOver = false;       ///< to another queue family: every output is written anew in every frame
};

class Group {
public:
    [[nodiscard]] static Result<std::shared_ptr<Group>> create(const GroupShared& shared, std::shared_ptr<Asset> asset,
                                                               const SuppleGroupDesc& desc);

    [[nodiscard]] const Asset& asset() const { return *asset_; }
    /// Whether the indirect commands that draw an instance name a first instance when it hides parts.
    [[nodiscard]] bool drawsByRanges() const { return surfaces_.haveGrids(); }
    void fill(SuppleGroupInfo& info) const;
    /// `surface` is below surfaces().size().
    void fill(SuppleSurfaceInfo& info, uint32_t surface) const;
    [[nodiscard]] Status setRate(uint32_t rate) { return surfaces_.setRate(rate); }
    /// Without the asset's tables and the view's buffers.
    [[nodiscard]] gpu::MemoryUse memoryUse() const;

    [[nodiscard]] InstanceSet& instances() { return *instances_; }
    [[nodiscard]] const InstanceSet& instances() const { return *instances_; }
    [[nodiscard]] InstanceSlots& slots() { return instances_->slots(); }
    [[nodiscard]] PoseSource& poses() { return instances_->poses(); }
    [[nodiscard]] Surfaces& surfaces() { return surfaces_; }
    [[nodiscard]] const Surfaces& surfaces() const { return surfaces_; }
    // Null if the group belongs to no view.
    [[nodiscard]] View* view() const { return view_.get(); }
    [[nodiscard]] Culling* culling() { return culling_; }
    [[nodiscard]] const Culling* culling() const { return culling_; }

    // Recording, in the order of a frame; runtime/frame.cpp has the passes.
    /// Static tables and first-use clears. The caller sees to it that no other thread does the same: the asset's tables
    /// are shared.
    [[nodiscard]] bool staticsPending() const;
    VkDeviceSize recordStatics(VkCommandBuffer commandBuffer, uint64_t frame);
    /// This frame's poses, its list of instances and what to draw of them.
    PassCost recordUpload(VkCommandBuffer commandBuffer, uint64_t frame);
    /// Context::recordWarmUp.
    void recordWarmUp(VkCommandBuffer commandBuffer, uint64_t frame);
    void addTransfers(Transfers& transfers) const;

    /// Vertices of the view's budget that an instance needs at its coarsest, and all that the host shows.
    [[nodiscard]] uint32_t leastVertices() const { return culling_ != nullptr ? surfaces_.leastVertices() : 0; }
    [[nodiscard]] uint64_t leastVerticesOfAll() const {
        return uint64_t{leastVertices()} * instances_->windows().visible;
    }

    /// The last frame that has the group's passes, and the last that has anything of it.
    [[nodiscard]] uint64_t passesFrame() const { return passesFrame_; }
    [[nodiscard]] uint64_t lastRecordedFrame() const { return lastRecordedFrame_; }
    void cancelFrame(uint64_t frame);
    void releaseStaging(uint64_t completedFrame);

    /// The groups of a suppleRecord are linked, so that each handle is resolved once and nothing is allocated. Valid
    /// while that call records.
    struct Link {
        Group* next = nullptr;
        SuppleGroup handle{};
        bool leadsView = false; ///< it is the first group of its view
    };
    Link link;

private:
    [[nodiscard]] Status createRest(const GroupShared& shared, const SuppleGroupDesc& desc);
    void planCulling(const GroupShared& shared, bool oneLevel, gpu::BufferPlan& device, gpu::BufferPlan& staging);
    [[nodiscard]] Status createVisibility(bool listsParts);

    std::shared_ptr<Asset> asset_;
    std::shared_ptr<View> view_;
    gpu::BufferSet buffers_, staging_; ///< of all parts
    std::unique_ptr<InstanceSet> instances_;
    std::unique_ptr<Visibility> visibility_;
    Culling* culling_ = nullptr; ///< visibility_, if the group belongs to a view
    Surfaces surfaces_;
    RecordedOnce clear_; ///< of what culling remembers from frame to frame
    uint64_t passesFrame_ = 0, lastRecordedFrame_ = 0;
};

} // namespace supple::runtime
