// Instances: their slots, poses and deformed cages. Groups that draw the same instances share a set.
#pragma once

#include "gpu/buffer_plan.h"
#include "runtime/asset.h"
#include "runtime/instance_listing.h"
#include "runtime/instance_slots.h"
#include "runtime/pose_source.h"
#include "runtime/slot_values.h"
#include "runtime/transfers.h"
#include "skinning/deform_kernels.h"

#include <memory>
#include <vector>

namespace supple::runtime {

class InstanceSet final : public gpu::FrameMembers {
public:
    struct Desc {
        const gpu::Device* device = nullptr;
        skinning::PoseKernels* pose = nullptr; ///< null unless instances play on the device
        std::shared_ptr<Asset> asset;
        SupplePoseSource source = SUPPLE_POSES_SET;
        skinning::SkinningMode mode = skinning::SkinningMode::linear;
        uint32_t capacity = 0;
        uint32_t firstGeneration = 1;
        uint32_t framesInFlight = 2;
        StateRoom room;
        bool handsOver = false; ///< to another queue family: user data is written anew in every frame
    };
    /// Prepares the pipelines.
    [[nodiscard]] static Result<std::shared_ptr<InstanceSet>> create(const Desc& desc);
    /// What passes bind of an instance: with `windowed`, poses begin where descriptors may.
    [[nodiscard]] BoundBytes boundBytes(bool windowed) const;
    /// Behind create(). `windowed`: there are several windows.
    [[nodiscard]] Status makeBuffers(bool windowed);
    /// `listing`: of the group that poses the instances. It must outlive the set, or not record any more.
    [[nodiscard]] Status createSets(const InstanceListing& listing);

    [[nodiscard]] InstanceSlots& slots() { return slots_; }
    [[nodiscard]] const InstanceSlots& slots() const { return slots_; }
    [[nodiscard]] SupplePoseSource source() const { return desc_.source; }
    [[nodiscard]] skinning::SkinningMode skinning() const { return desc_.mode; }
    /// With springs only if some joints of the asset swing, with jiggles only if some of its vertices do.
    [[nodiscard]] const StateRoom& room() const { return desc_.room; }
    [[nodiscard]] PoseSource& poses() { return *poses_; }
    [[nodiscard]] const PoseSource& poses() const { return *poses_; }
    [[nodiscard]] UserData& userData() { return userData_; }
    /// Without a buffer if the character has no crease sets.
    [[nodiscard]] const CreaseAlphas& creaseAlphas() const { return creaseAlphas_; }
    /// What an instance says of a crease set: P_m's alpha, or negative: each edge has its own.
    void setCreaseAlpha(uint32_t slot, uint32_t set, float alpha);
    /// A new instance has the slot: it has what nobody has set.
    void reset(uint32_t slot);
    /// Cage vertices from one instance to the next.
    [[nodiscard]] static uint32_t cageStrideOf(uint32_t cageVertices);

    [[nodiscard]] uint32_t cageStride() const { return cageStride_; }
    [[nodiscard]] const gpu::PlannedBuffer& cages() const { return cages_; }
    [[nodiscard]] const gpu::PlannedBuffer& palettes() const { return palettes_; }
    [[nodiscard]] const skinning::PoseLayout& poseLayout() const { return layout_; }
    [[nodiscard]] gpu::MemoryUse memoryUse() const {
        gpu::MemoryUse use = buffers_.use();
        use += staging_.use();
        use += poses_->memoryUse();
        return use;
    }
    [[nodiscard]] uint32_t capacity() const { return desc_.capacity; }
    void fill(SuppleGroupInfo& output) const;
    void addTransfers(Transfers& transfers) const;

    /// Takes over the instances of another set, which has no more than this one's capacity: handles, poses, places.
    void takeOver(InstanceSet& other, const AssetMatch& match);
    /// This frame's poses and user data.
    PassCost recordPoses(VkCommandBuffer commandBuffer, const HostPoses::Frame& frame, const glm::dvec3& origin);

private:
    /// The asset has its clip table: whether joints swing, and not too many.
    [[nodiscard]] Status takeSprings();
    /// Whether something is soft, and takes not too much; then the asset has its tables.
    [[nodiscard]] Status takeSoft();
    /// Those of the pose pass.
    [[nodiscard]] Status makePipelines();
    void takeCreaseAlphas(const InstanceSet& other, const AssetMatch& match);

    Desc desc_;
    skinning::PosePipelines pipelines_;
    skinning::PoseLayout layout_;
    InstanceSlots slots_;
    std::unique_ptr<PoseSource> poses_;
    uint32_t cageStride_ = 0;

    gpu::BufferSet buffers_, staging_;
    gpu::PlannedBuffer palettes_, cages_;
    UserData userData_;
    CreaseAlphas creaseAlphas_;
};

} // namespace supple::runtime
