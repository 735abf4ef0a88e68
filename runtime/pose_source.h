// Where the poses of a group's instances come from: one implementation per SupplePoseSource.
#pragma once

#include "gpu/buffer_plan.h"
#include "gpu/frame_member.h"
#include "runtime/asset.h"
#include "runtime/host_poses.h"
#include "runtime/instance_slots.h"
#include "runtime/instance_windows.h"
#include "runtime/pass_cost.h"
#include "runtime/playback.h"
#include "skinning/pose_kernels.h"

#include <memory>
#include <optional>

namespace supple::runtime {

/// The base class is a source that the host fills on the device by itself: nothing is set, uploaded or computed.
class PoseSource : public gpu::FrameMember {
public:
    PoseSource() = default;
    virtual ~PoseSource() = default;
    PoseSource(const PoseSource&) = delete;
    PoseSource& operator=(const PoseSource&) = delete;

    // Setting, on the CPU. Only sources of which the host sets something are asked.
    virtual void reset(uint32_t /*slot*/) {} ///< a new instance: bind pose, identity transform
    virtual void setTransform(uint32_t /*slot*/, const glm::mat4& /*transform*/) {}
    virtual void setPosition(uint32_t /*slot*/, const glm::dvec3& /*position*/) {}
    /// Where the coordinates of the device begin, for the next recording and for jointTransform(). `end`: slots below
    /// it may be in use.
    virtual void setOrigin(const glm::dvec3& /*origin*/, uint32_t /*end*/) {}
    virtual void teleport(uint32_t /*slot*/) {}             ///< it has jumped to where the next recording places it
    virtual void setWind(const glm::dvec3& /*velocity*/) {} ///< about all instances, from the group's time on
    virtual void settleSteps() {}                           ///< all that runs steps begins anew
    virtual void setMorphWeights(uint32_t /*slot*/, const float* /*weights*/) {} ///< null: the pose's own again
    /// Where a joint is, as the next recording poses and places the instance.
    [[nodiscard]] virtual glm::mat4 jointTransform(uint32_t /*slot*/, uint32_t /*joint*/) { return glm::mat4(1.0f); }
    /// A box that holds the instance's cage, as the next recording poses and places it; nothing if nobody knows.
    [[nodiscard]] virtual std::optional<skinning::Box> boundsOf(uint32_t /*slot*/, const skinning::Reach& /*reach*/) {
        return std::nullopt;
    }
    /// Another number whenever boundsOf() may give another box than the last time; never 0.
    [[nodiscard]] virtual uint64_t boundsVersion(uint32_t /*slot*/) const { return 1; }
    /// The same of all slots: as long as it stays, none of theirs changes. 0: ask for each.
    [[nodiscard]] virtual uint64_t boundsVersions() const { return 0; }
    // Modifiers; only sources that take them are asked.
    [[nodiscard]] virtual bool takesModifiers() const { return false; }
    virtual void setModifiers(uint32_t /*slot*/, std::span<const PlacedModifier> /*modifiers*/) {}
    virtual void setModifierGoal(uint32_t /*slot*/, uint32_t /*index*/, const ModifierGoal& /*goal*/) {}
    [[nodiscard]] virtual uint32_t modifierCount(uint32_t /*slot*/) { return 0; }
    [[nodiscard]] virtual std::span<const uint32_t> modifierWords(uint32_t /*slot*/, uint32_t /*index*/) { return {}; }
    [[nodiscard]] virtual HostPoses* host() { return nullptr; }
    [[nodiscard]] virtual Playback* playback() { return nullptr; }

    /// Takes over the instances of the first `count` slots of a source of the same kind.
    virtual void takeOver(PoseSource& /*other*/, uint32_t /*count*/, const AssetMatch& /*match*/) {}

    // Creation, in this order.
    virtual void plan(gpu::BufferPlan& /*staging*/) {}
    struct Buffers {
        VkBuffer poses = VK_NULL_HANDLE;
        VkBuffer instances = VK_NULL_HANDLE; ///< the lists of instances
        VkDeviceSize instanceBytes = 0;
        uint32_t windowSize = 0;
    };
    [[nodiscard]] virtual Status create(const Buffers& /*buffers*/) { return success(); }
    [[nodiscard]] virtual gpu::MemoryUse memoryUse() const { return {}; } ///< beside the planned buffers

    // Recording.
    /// The time of the frame is SuppleRecordDesc.time.
    virtual PassCost recordUpload(VkCommandBuffer /*commandBuffer*/, const HostPoses::Frame& /*frame*/,
                                  const InstanceSlots& /*slots*/) {
        return {};
    }
    // Where something is soft:
    [[nodiscard]] virtual StepPoses stepPoses() const { return {}; }
    /// What is listed of the frame that is recorded. `round`: PoseList::Window::rounds.
    [[nodiscard]] virtual const PoseList::Round* listedSteps(uint32_t /*window*/, uint32_t /*round*/) const {
        return nullptr;
    }
    /// The pose pass has seven parts with a barrier between each two. Whether the source has this one.
    [[nodiscard]] virtual bool has(Playback::Part /*part*/) const { return false; }
    virtual PassCost recordPart(gpu::Dispatches& /*dispatches*/, Playback::Part /*part*/,
                                const InstanceWindows& /*windows*/) const {
        return {};
    }
};

struct PoseSourceDesc {
    const gpu::Device* device = nullptr;
    skinning::PosePipelines pipelines; ///< where instances play on the device
    Asset* asset = nullptr;
    skinning::PoseLayout layout;
    uint32_t capacity = 0, framesInFlight = 2;
    StateRoom room;
};
[[nodiscard]] std::unique_ptr<PoseSource> makePoseSource(SupplePoseSource source, const PoseSourceDesc& desc);
/// Bytes per instance of what the source binds by windows.
[[nodiscard]] VkDeviceSize poseWindowBytes(SupplePoseSource source, const Asset& asset,
                                           const skinning::PoseLayout& layout, const StateRoom& room);

} // namespace supple::runtime
