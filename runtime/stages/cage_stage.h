// A stage between the joint palettes and the surfaces: it makes the deformed cages of a group's instances, or changes
// them, or hands them on. docs/architecture.md tells how to add one.
#pragma once

#include "gpu/buffer_plan.h"
#include "gpu/dispatches.h"
#include "gpu/frame_member.h"
#include "gpu/pipelines.h"
#include "runtime/asset_match.h"
#include "runtime/instance_set.h"
#include "runtime/pass_cost.h"
#include "runtime/surfaces.h"
#include "runtime/timings.h"

#include <memory>
#include <span>

namespace supple::runtime {

/// What the stages of a group are made from. All pointers must outlive them.
struct CageStageDesc {
    const gpu::Device* device = nullptr;
    const Asset* asset = nullptr;
    const SuppleGroupDesc* group = nullptr; ///< without the caller's pointers
    const InstanceSet* instances = nullptr;
    const Surfaces* surfaces = nullptr;
    uint32_t framesInFlight = 2;
    /// The instances are the group's own, and Supple deforms their cages. Otherwise a stage must not change cages.
    bool deforms = false;
};

/// What a stage binds once the plans are carried out.
struct CageBuffers {
    VkBuffer from = VK_NULL_HANDLE; ///< the cages as the stage before left them
    VkBuffer to = VK_NULL_HANDLE;   ///< where the stage writes; `from` unless it writesApart()
    uint32_t stride = 0;            ///< vertices from one instance to the next, in both
    const InstanceListing* listing = nullptr;
};

/// What a stage is told of a frame.
struct CageFrame {
    gpu::Dispatches& dispatches; ///< what is recorded beside them comes before those that wait
    uint64_t number = 0;
    /// Since the group's last recording, by the host's time (SuppleRecordDesc.time); never negative. 0 in the first.
    double seconds = 0.0;
    const InstanceWindows& windows; ///< which instances are listed
    /// Slots of listed instances that have no past here, rising: created, teleported or shown again. A new capacity or
    /// a reloaded asset makes no instance new. Empty if no stage of the group keeps instances.
    std::span<const uint32_t> newSlots;
    uint32_t surface = SUPPLE_NO_SURFACE; ///< which to work on (CageStageRow::perSurface)
};

/// A stage of one group. FrameMember has what it uploads once, its warm-up, and the ends of frames.
class CageStage : public gpu::FrameMembers {
public:
    virtual ~CageStage() = default;

    // Creation, in this order.
    /// What it binds of an instance, beside cages.
    [[nodiscard]] virtual BoundBytes boundBytes() const { return {}; }
    /// It cannot change cages in place: it reads other vertices than the one that it writes.
    [[nodiscard]] virtual bool writesApart() const { return false; }
    /// It keeps something of instances from frame to frame. Others are not told who is new (CageFrame::newSlots).
    [[nodiscard]] virtual bool keepsInstances() const { return false; }
    virtual void plan(gpu::BufferPlan& /*device*/, gpu::BufferPlan& /*staging*/) {}
    [[nodiscard]] virtual Status createSets(const CageBuffers& buffers) = 0;
    /// Takes over what the same stage of another group keeps of the instances in the first `count` slots: they go on
    /// where they were. What is not taken over must begin anew.
    virtual void takeOver(CageStage& /*other*/, uint32_t /*count*/, const AssetMatch& /*match*/) {}

    [[nodiscard]] virtual gpu::MemoryUse memoryUse() const { return {}; } ///< beside the planned buffers
    /// The cages that a surface is made from; null: those that all surfaces have.
    [[nodiscard]] virtual const gpu::PlannedBuffer* cagesOf(uint32_t /*surface*/) const { return nullptr; }

    // Recording. Allocates nothing.
    /// With the uploads of the frame: copies and fills, before the barrier that lets stages read them. The bytes. Here
    /// the stage forgets `newSlots`.
    virtual VkDeviceSize recordUpload(const CageFrame& /*frame*/) { return 0; }
    /// Barriers stand before and behind it.
    virtual PassCost record(const CageFrame& frame) = 0;
    /// A round of steps that comes before all other passes (runtime/early_steps.h), with the same barriers.
    virtual void recordEarly(const CageFrame& /*frame*/, uint32_t /*round*/) {}
};

/// What a stage has once per context: layouts and pipelines.
class CageKernels {
public:
    CageKernels() = default;
    virtual ~CageKernels() = default;
    CageKernels(const CageKernels&) = delete;
    CageKernels& operator=(const CageKernels&) = delete;
};

/// What the pipelines of a group's stages depend on, before there is a group.
struct PlannedStages {
    skinning::SkinningMode skinning = skinning::SkinningMode::linear;
    bool morphs = false;  ///< the character has morph targets
    bool deforms = false; ///< as CageStageDesc::deforms
    bool pieces = false;  ///< a surface is made of some of the parts
    bool jiggles = false; ///< vertices do
    bool cloths = false;  ///< there are some
};

struct CageStageRow {
    SupplePass pass;         ///< its label, and the timings that it counts in
    bool perSurface = false; ///< recorded for each surface of a group, else once
    /// Whether a group has the stage.
    bool (*wants)(const CageStageDesc&);
    /// Called for the first group that wants it. Rows with the same function share what it makes.
    Result<std::unique_ptr<CageKernels>> (*makeKernels)(const gpu::Device&, gpu::Pipelines&);
    Result<std::unique_ptr<CageStage>> (*make)(const CageStageDesc&, CageKernels&);
    /// Makes the pipelines of a group that is to come, if it will have the stage: on any thread, also beside recording.
    /// Null: they are made with the kernels.
    Status (*makePipelines)(const PlannedStages&, const CageKernels&) = nullptr;
    /// The cages that it leaves lie within what joint palettes bound (skinning/reach.h), and it keeps nothing from
    /// frame to frame. Of groups with other stages all instances are posed, in sight or not.
    bool keepsReach = false;
    /// What its dispatches of a frame follow from. Those that stand come in the same order as long as the windows of
    /// instances do not change, and those of no workgroups too (gpu::Dispatches::takesEmpty()).
    enum class Tasks {
        anew,    ///< who knows: groups with such a stage record all that they dispatch anew in every frame
        written, ///< they stand, but for push constants and sizes
        stand    ///< as they are
    };
    Tasks tasks = Tasks::anew;
};

} // namespace supple::runtime
