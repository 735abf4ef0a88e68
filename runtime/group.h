// A group: instances of one asset, which instances are seen, and the surfaces that make their vertices. A group may
// draw the instances of another one, which it follows; then the other one deforms them.
#pragma once

#include "base/result.h"
#include "gpu/memory.h"
#include "runtime/asset.h"
#include "runtime/asset_match.h"
#include "runtime/culling/bounds_readback.h"
#include "runtime/culling/culling.h"
#include "runtime/culling/instance_boxes.h"
#include "runtime/culling/listed_bounds.h"
#include "runtime/culling/out_of_sight.h"
#include "runtime/group_recipe.h"
#include "runtime/instance_set.h"
#include "runtime/points/point_sets.h"
#include "runtime/recording/stage_hashes.h"
#include "runtime/stages/cage_stages.h"
#include "runtime/surface_buffers.h"
#include "runtime/surfaces.h"
#include "runtime/transfers.h"
#include "runtime/view.h"
#include "supple/supple.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace supple::runtime {

class Group;

/// What the group borrows from its context.
struct GroupShared {
    const gpu::Device* device = nullptr;
    gpu::Pipelines* pipelines = nullptr;
    CageStageTable* stages = nullptr;
    skinning::PoseKernels* pose = nullptr; ///< for groups that play on the device
    surface::Programs* surface = nullptr;
    gpu::StaticBuffers* pairs = nullptr;         ///< of parameters
    BoundsKernels* bounds = nullptr;             ///< for groups with bounds
    const OcclusionKernels* occlusion = nullptr; ///< for groups of views with occlusion
    std::shared_ptr<View> view;                  ///< of the description
    std::shared_ptr<InstanceSet> instances;      ///< of the group that this one follows; null: it has its own
    const Group* leader = nullptr;               ///< that group
    uint32_t framesInFlight = 2;
    uint32_t firstGeneration = 1;              ///< of the instances
    uint64_t number = 0;                       ///< no other group of the context ever has it
    bool handsOver = false;                    ///< to another queue family: every output is written anew in every frame
    const Group* before = nullptr;             ///< whose indices it may take over; null: none
    std::shared_ptr<const StageHashes> hashes; ///< of a recording; null: there are none
};

class Group final : public gpu::FrameMembers {
public:
    [[nodiscard]] static Result<std::shared_ptr<Group>> create(const GroupShared& shared, std::shared_ptr<Asset> asset,
                                                               const SuppleGroupDesc& desc);

    /// A group that is made of `recipe`, and of this group's instances if it has its own.
    [[nodiscard]] Result<std::shared_ptr<Group>> remade(const GroupShared& shared, std::shared_ptr<Asset> asset,
                                                        const GroupRecipe& recipe, const AssetMatch& match);
    [[nodiscard]] const GroupRecipe& recipe() const { return recipe_; }

    [[nodiscard]] const Asset& asset() const { return *asset_; }
    [[nodiscard]] const std::shared_ptr<Asset>& sharedAsset() const { return asset_; }
    [[nodiscard]] const std::shared_ptr<View>& sharedView() const { return view_; }
    [[nodiscard]] const std::shared_ptr<InstanceSet>& sharedInstances() const { return instances_; }
    /// Whether the indirect commands that draw an instance name a first instance when it hides parts.
    [[nodiscard]] bool drawsByRanges() const { return surfaces_.haveGrids(); }
    void fill(SuppleGroupInfo& info) const;
    /// `surface` is below surfaces().size().
    void fill(SuppleSurfaceInfo& info, uint32_t surface) const;
    [[nodiscard]] Status setRate(uint32_t rate);
    /// Without the asset's tables, the view's buffers, and the instances of another group.
    [[nodiscard]] gpu::MemoryUse memoryUse() const;
    /// What its passes need in a frame: those that groups share, and early steps (runtime/early_steps.h).
    [[nodiscard]] const gpu::TaskNeeds& passNeeds() const { return passNeeds_; }
    [[nodiscard]] const gpu::TaskNeeds& earlyNeeds() const { return earlyNeeds_; }
    [[nodiscard]] gpu::TaskNeeds taskNeeds() const {
        gpu::TaskNeeds needs = passNeeds_;
        needs += earlyNeeds_;
        return needs;
    }
    /// In the frame that is recorded.
    [[nodiscard]] uint32_t earlyRounds() const {
        const Playback* const playback = follows() ? nullptr : instances_->poses().playback();
        return playback != nullptr ? playback->earlyRounds() : 0;
    }
    /// Who records its tasks, and what they follow from in this frame.
    [[nodiscard]] gpu::TaskOwner taskOwner() const;
    [[nodiscard]] uint64_t number() const { return number_; }
    /// Whether tasks of a frame may stand in others.
    [[nodiscard]] bool keepsTasks() const { return stages_.tasks() != CageStageRow::Tasks::anew; }

    [[nodiscard]] InstanceSet& instances() { return *instances_; }
    [[nodiscard]] const InstanceSet& instances() const { return *instances_; }
    [[nodiscard]] const InstanceListing& listing() const { return listing_; }
    [[nodiscard]] const InstanceWindows& windows() const { return listing_.windows(); }
    /// The group whose instances it draws, as its description says; 0: they are its own.
    [[nodiscard]] uint64_t leader() const { return leader_; }
    [[nodiscard]] bool follows() const { return leader() != 0; }
    [[nodiscard]] InstanceSlots& slots() { return instances_->slots(); }
    [[nodiscard]] PoseSource& poses() { return instances_->poses(); }
    /// What makes the cages of its surfaces.
    [[nodiscard]] CageStages& stages() { return stages_; }
    [[nodiscard]] PointSets& points() { return points_; }
    [[nodiscard]] const PointSets& points() const { return points_; }
    /// What its point sets are made from.
    [[nodiscard]] PointSource pointSource() const;
    [[nodiscard]] Surfaces& surfaces() { return surfaces_; }
    [[nodiscard]] const Surfaces& surfaces() const { return surfaces_; }
    // Null if the group belongs to no view.
    [[nodiscard]] View* view() const { return view_.get(); }
    [[nodiscard]] Culling* culling() { return culling_; }
    [[nodiscard]] const Culling* culling() const { return culling_; }
    /// Visible instances that the last recording has left out before they were posed.
    [[nodiscard]] uint32_t unposed() const;
    /// Before a frame: gives back the memory of its surfaces, or takes it again if there is an instance to draw. True:
    /// other buffers are there than before. `hashes`: of a recording, or null.
    [[nodiscard]] Result<bool> fitMemory(uint64_t frame, uint64_t completedFrame,
                                         const std::shared_ptr<const StageHashes>& hashes);
    /// The host has not been told yet that there is no memory.
    [[nodiscard]] bool lacksMemoryAnew() { return !std::exchange(lackTold_, true); }
    /// What it has given back and takes again.
    [[nodiscard]] VkDeviceSize givenBackBytes() const { return surfaceBuffers_.freedBytes(); }

    /// Groups of a view: whether the frame lists what is seen. Where nothing was listed and nothing is to list, lists,
    /// arguments and draws stand.
    [[nodiscard]] bool listsSeen() const { return listsSeen_; }

    /// Whether the device finds the bounds of instances.
    [[nodiscard]] bool hasBounds() const { return culling_ != nullptr || listedBounds_ != nullptr; }
    [[nodiscard]] SuppleBufferRange bounds() const; ///< if hasBounds()
    /// Null unless the host reads them.
    [[nodiscard]] BoundsReadback* boundsReadback() const { return boundsReadback_.get(); }
    /// How far the surfaces may lie outside the box of the cage, as a part of its size.
    [[nodiscard]] float boundsMargin() const;

    // Recording, in the order of a frame; runtime/frame.cpp has the passes.
    [[nodiscard]] bool staticsPending() const override { return lacksStatics() || points_.uploadsPending(); }
    /// Whether frames leave the group out for want of static data.
    [[nodiscard]] bool lacksStatics() const { return !staticsThere_ && FrameMembers::staticsPending(); }
    VkDeviceSize recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) override;
    /// All are recorded. They stay, unless the frame that has them is cancelled.
    void noteStaticsThere() { staticsThere_ = true; }
    [[nodiscard]] bool staticsThere() const { return staticsThere_; }
    /// Segments of its clips may be due in any frame.
    [[nodiscard]] bool streamsClips() const { return streamsClips_; }
    /// `number`: one that no group has had. Tasks that were recorded under the last one are not gone on from.
    void noteBuffersChanged(uint64_t number) {
        number_ = number;
        passNeeds_ = countTasks();
        earlyNeeds_ = countEarlyTasks();
    }
    /// What a frame is for all groups that are recorded in it.
    struct FrameInfo {
        uint64_t number = 0;
        double time = 0.0;             ///< the host's, in seconds
        glm::dvec3 origin{0.0};        ///< where the coordinates of the device begin
        const Group* leader = nullptr; ///< of a group that follows another one
    };
    /// The frame leaves the group out, though it is recorded: what it needs is not there yet. Its draws draw nothing,
    /// but for those of a view, which has them for all its groups.
    void recordWaiting(VkCommandBuffer commandBuffer, uint64_t frame);
    /// This frame's poses, its list of instances and what to draw of them.
    PassCost recordUpload(VkCommandBuffer commandBuffer, const FrameInfo& frame);
    /// Notes that the frame has something of the group. recordStatics() and recordUpload() do so themselves.
    void noteRecorded(uint64_t frame) { lastRecordedFrame_ = frame; }
    /// Behind the deformed cages.
    PassCost recordPoints(gpu::Dispatches& dispatches) { return points_.record(dispatches, passesFrame_, pastStep_); }
    /// Behind the surface vertices: the points that lie on them.
    PassCost recordVertexPoints(gpu::Dispatches& dispatches) const { return points_.recordCopies(dispatches); }
    /// If hasBounds().
    PassCost recordBounds(gpu::Dispatches& dispatches) const;
    /// If boundsReadback(): behind the bounds, once they may be copied.
    void recordBoundsReadback(VkCommandBuffer commandBuffer, uint64_t frame);
    /// Makes ready for recordHashes(), if that has not been done.
    [[nodiscard]] Status createHashes(const std::shared_ptr<const StageHashes>& hashes);
    /// Hashes of what its passes have written; how many at most. None before createHashes().
    [[nodiscard]] uint32_t hashCount() const { return static_cast<uint32_t>(hashed_.size()); }
    void recordHashes(StageHashes::Recording& recording, bool withSurfaces) const;
    /// What the group hands to the queue family that draws; withView: and what its view does.
    void addTransfers(Transfers& transfers, bool withView) const;

    /// Vertices of the view's budget that an instance needs at its coarsest, and all that the host shows.
    [[nodiscard]] uint32_t leastVertices() const { return culling_ != nullptr ? surfaces_.leastVertices() : 0; }
    /// Patches of an instance that are drawn at levels.
    [[nodiscard]] uint32_t patchesAtLevels() const { return patchesAtLevels_; }
    [[nodiscard]] uint64_t leastVerticesOfAll() const { return uint64_t{leastVertices()} * windows().visible; }
    /// The same of the view's pool.
    [[nodiscard]] uint64_t poolUnitsOfAll() const {
        return culling_ != nullptr ? uint64_t{culling_->instanceUnits()} * windows().visible : 0;
    }

    /// The host has asked for what it draws of the group.
    void noteOutputsAsked() { outputsAsked_ = true; }
    /// Called behind every frame in which other groups were recorded. True once: when there have been so many of these
    /// that the host seems to draw the group without recording it (SUPPLE_MESSAGE_NEVER_RECORDED).
    [[nodiscard]] bool noteUnrecordedFrame();

    /// The last frame that has the group's passes, and the last that has anything of it.
    [[nodiscard]] uint64_t passesFrame() const { return passesFrame_; }
    /// The last that suppleRecord was called for it: with its passes or, as it waits, without.
    [[nodiscard]] uint64_t askedFrame() const { return std::max(passesFrame_, waitingFrame_); }
    /// Whether the frame has left it out.
    [[nodiscard]] bool waitsIn(uint64_t frame) const { return waitingFrame_ == frame && frame != 0; }
    [[nodiscard]] uint64_t lastRecordedFrame() const { return lastRecordedFrame_; }
    void cancelFrame(uint64_t frame) override;

    /// The groups of a suppleRecord are linked, so that each handle is resolved once and nothing is allocated. Valid
    /// while that call records.
    struct Link {
        Group* next = nullptr;
        SuppleGroup handle{};
        uint64_t call = 0;      ///< of suppleRecord, that lists it
        bool leadsView = false; ///< it is the first group of its view
        uint32_t number = 0;    ///< in the order of the frame
        uint32_t inView = 0;    ///< the same among the groups of its view
    };
    Link link;

private:
    [[nodiscard]] Status createInstances(const GroupShared& shared);
    [[nodiscard]] Status createListing(const GroupShared& shared);
    [[nodiscard]] Status createRest(const GroupShared& shared);
    void planCulling(const GroupShared& shared, gpu::BufferPlan& device, gpu::BufferPlan& staging);
    [[nodiscard]] bool sharesCoefficients() const {
        return surfaces_.any([](const Tessellation& surface) { return surface.sharesCoefficients(); });
    }
    void planBounds(const GroupShared& shared, gpu::BufferPlan& device);
    /// Whether the view's pool has room for an instance.
    [[nodiscard]] Status checkPool() const;
    [[nodiscard]] Status createVisibility();
    [[nodiscard]] gpu::TaskNeeds countTasks() const;
    [[nodiscard]] gpu::TaskNeeds countEarlyTasks() const;
    /// Whether other groups draw its instances too.
    [[nodiscard]] bool drawnElsewhere() const { return instances_.use_count() > 1; }
    /// What steps do to small instances is not seen: they run none.
    [[nodiscard]] bool fadesSteps() const;
    /// True if others than before are out of sight.
    bool findUnseen();
    /// What the frame has of the coefficients that both groups read.
    void followCoefficients(const Group& leader);
    // runtime/group_memory.cpp
    /// Whether an instance would be drawn, if the next frame were recorded now.
    [[nodiscard]] bool findsInstance();
    void giveSurfaces(uint64_t frame);
    void freeSurfaces();
    /// They have new buffers.
    [[nodiscard]] Status remakeSurfaces();
    [[nodiscard]] Status takeSurfaces(uint64_t frame, const std::shared_ptr<const StageHashes>& hashes);
    /// Finds listsSeen(). True if it is another than before.
    bool findList(uint64_t frame);
    /// With update rates: chooses them by sizes on the screen, and lists what is posed.
    PassCost recordPoseList(VkCommandBuffer commandBuffer, uint64_t frame);
    /// What is hashed of the group, a hash each.
    struct Hashed {
        HashedStage stage = HashedStage::palettes;
        uint32_t surface = 0;
        uint32_t parts = 1;
    };
    [[nodiscard]] HashedPart partOf(const Hashed& hashed, uint32_t part) const;
    /// What frames concern: once all of it is there.
    void addMembers(const GroupShared& shared);

    // What every recording reads and writes stands together, behind `link`: where there are many groups, a frame waits
    // for their memory.
    uint64_t passesFrame_ = 0, passesBefore_ = 0, waitingFrame_ = 0, lastRecordedFrame_ = 0;
    uint64_t leader_ = 0;                    ///< the group whose instances it draws; 0: they are its own
    uint64_t number_ = 0, tasksVersion_ = 0; ///< the version rises when the tasks of all passes may change
    gpu::TaskNeeds passNeeds_, earlyNeeds_;
    Culling* culling_ = nullptr;   ///< visibility_, if the group belongs to a view
    uint32_t sharers_ = 0;         ///< of the last recording: Sharers::end()
    uint32_t patchesAtLevels_ = 0; ///< in a view
    glm::dvec3 origin_{0.0};       ///< of the last recording
    glm::vec3 pastStep_{0.0f};     ///< of the last recording
    bool handsOver_ = false;       ///< to another queue family
    bool streamsClips_ = false;    ///< the asset has a ClipStream
    bool listsSeen_ = false, outputsAsked_ = false, staticsThere_ = false, lackTold_ = false;
    bool leftOutAll_ = false;       ///< by the last recording: InstanceListing::leavesOutAll()
    uint32_t unrecordedFrames_ = 0; ///< with outputs asked for and instances to see
    RecordedOnce noDraws_;
    RecordedOnce emptyList_; ///< the list pass of a frame in which nothing is to list

    std::shared_ptr<Asset> asset_;
    std::shared_ptr<View> view_;
    GroupRecipe recipe_;
    SuppleGroupDesc desc_{}; ///< without pointers
    uint32_t rate_ = 0;      ///< that was set last; 0: none
    const gpu::Device* device_ = nullptr;
    gpu::BufferSet buffers_, staging_; ///< of all but the instances, and but what surfaces may give back
    SurfaceBuffers surfaceBuffers_;
    SharerPlace place_; ///< during creation: among those who share the coefficients of the group that this one follows
    std::shared_ptr<InstanceSet> instances_;
    DrawnParts drawnParts_;
    InstanceListing listing_;
    InstanceBoxes boxes_; ///< if the group belongs to a view that asks for them
    OutOfSight outOfSight_;
    std::unique_ptr<Visibility> visibility_;
    std::unique_ptr<ListedBounds> listedBounds_; ///< if it belongs to none and has bounds
    std::unique_ptr<BoundsReadback> boundsReadback_;
    std::vector<Hashed> hashed_;
    std::unique_ptr<HashedParts> hashes_; ///< of hashed_
    CageStages stages_;
    PointSets points_;
    Surfaces surfaces_;
};

} // namespace supple::runtime
