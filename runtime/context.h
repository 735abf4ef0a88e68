// The context: the borrowed device, the pipelines, the handles, and what is in flight.
#pragma once

#include "gpu/device.h"
#include "gpu/pipelines.h"
#include "gpu/static_buffers.h"
#include "gpu/tasks.h"
#include "gpu/uploads.h"
#include "runtime/asset.h"
#include "runtime/group.h"
#include "runtime/planned_pipelines.h"
#include "runtime/queries/query_pool.h"
#include "runtime/recording/call_keeper.h"
#include "runtime/recording/recorder.h"
#include "runtime/shared_kernels.h"
#include "runtime/slot_map.h"
#include "runtime/timings.h"
#include "runtime/view.h"
#include "supple/supple.h"
#include "surface/programs.h"

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace supple::runtime {

struct Frame;

class Context {
    std::unique_ptr<gpu::Device> device_; ///< first, so that it goes last: everything below holds its address
    std::unique_ptr<gpu::Pipelines> pipelines_;

public:
    Context() = default;
    /// Ends the recording.
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    /// `shaders`, `stages`: tests put mutated code and stages of their own in. `stages` must outlive the context.
    [[nodiscard]] static Result<std::unique_ptr<Context>>
    create(const SuppleContextDesc& desc, const surface::Shaders& shaders = surface::Shaders::embedded(),
           std::span<const CageStageRow> stages = cageStageRows());

    void log(SuppleSeverity severity, SuppleMessage message, const std::string& text) const;
    /// Once the device is lost, nothing that needs it is tried again.
    [[nodiscard]] bool lost() const { return lost_; }
    void setLost() { lost_ = true; }

    [[nodiscard]] Status beginFrame(uint64_t frame, uint64_t completedFrame);
    [[nodiscard]] Status cancelFrame();
    [[nodiscard]] Status recordUploads(VkCommandBuffer commandBuffer);
    /// Every kernel that the groups may run, as dispatches of nothing, behind the uploads of recordUploads: drivers
    /// that compile a pipeline at its first dispatch do it then.
    [[nodiscard]] Status recordWarmUp(VkCommandBuffer commandBuffer, std::span<const SuppleGroup> wanted);
    /// What recordPendingStatics() has done.
    struct Statics {
        VkDeviceSize bytes = 0; ///< uploaded
        bool there = false;     ///< all that the group needs is on the device
    };
    /// Static data of the group, if any is due. Groups of other threads may share it.
    [[nodiscard]] Statics recordPendingStatics(VkCommandBuffer commandBuffer, Group& group);
    /// Makes every pipeline that the group will need. Any thread may call it, beside all that others do.
    [[nodiscard]] Status makePipelines(const Prepared& prepared, const PlannedGroup& group);
    /// Bytes of static data a frame uploads at most; 0: no bound.
    [[nodiscard]] Status setUploadBudget(VkDeviceSize bytes);
    /// What one group needs, with what it shares.
    [[nodiscard]] SuppleUploadState uploadState(const Group& group) const;
    [[nodiscard]] SuppleUploadState uploadState(Asset& asset) const;
    /// What assets, groups and views have.
    [[nodiscard]] SuppleUploadState uploadState() const;
    [[nodiscard]] std::span<const CageStageRow> stageRows() const { return stages_.rows(); }
    /// The frame's passes in order; see frame.cpp.
    [[nodiscard]] Status record(VkCommandBuffer commandBuffer, const SuppleRecordDesc& desc);
    /// For runtime/early_steps.h, beside those that the frame's passes share.
    [[nodiscard]] gpu::OwnDispatches earlyDispatches(const Frame& frame) const;
    [[nodiscard]] static SuppleSyncScope firstScope();
    [[nodiscard]] static SuppleSyncScope lastScope();
    /// Fills as much of `out` as there is; the number of barriers.
    [[nodiscard]] Result<uint32_t> acquireBarriers(std::span<const SuppleGroup> groups, SuppleSyncScope use,
                                                   std::span<VkBufferMemoryBarrier2> out) const;

    /// What everything takes that is not yet freed.
    [[nodiscard]] const gpu::MemoryUse& memoryUse() const { return device_->ledger->use; }
    /// 0: none. `allowsMore` is asked when an allocation would exceed it.
    void setMemoryBudget(VkDeviceSize bytes, std::function<bool(const gpu::MemoryRequest&)> allowsMore);

    /// What a reader has to say of a character.
    void tellWarnings(const cage::Character& character) const;
    [[nodiscard]] const gpu::Device& device() const { return *device_; }
    [[nodiscard]] bool isWide() const { return device_->mapping.wide; } ///< gpu/mapping.h
    /// Whether draws can leave out parts: their indirect commands then have a first instance.
    [[nodiscard]] bool hidesInDraws() const { return device_->drawIndirectFirstInstance; }
    /// Whether a group draws these instances by indirect commands of ranges: those have a first instance if parts hide.
    [[nodiscard]] bool drawsByRanges(const InstanceSet& instances) const;
    /// Whether a group draws these instances, or some of their parts, with the scheme.
    [[nodiscard]] bool draws(const InstanceSet& instances, SuppleScheme scheme) const;
    /// The device's limit for the sides of 2D images.
    [[nodiscard]] uint32_t maxImageSide() const { return device_->limits.maxImageDimension2D; }

    /// `clipPoolBytes`: SuppleAssetDesc.
    [[nodiscard]] Result<uint64_t> createAsset(cage::Character character, uint64_t clipPoolBytes);
    [[nodiscard]] Result<uint64_t> createAsset(std::shared_ptr<const Prepared> prepared, uint64_t clipPoolBytes);
    [[nodiscard]] Result<uint64_t> createGroup(const SuppleGroupDesc& desc);
    bool destroyGroup(uint64_t id);
    /// `desc`: its structSize and its numbers are checked.
    [[nodiscard]] Result<uint64_t> createPointSet(const SupplePointSetDesc& desc);
    bool destroyPointSet(uint64_t id);
    /// `desc`: its structSize, its numbers and its handles are checked.
    [[nodiscard]] Result<uint64_t> createQueryPool(const SuppleQueryPoolDesc& desc);
    bool destroyQueryPool(uint64_t id);
    /// `desc`: its structSize and its numbers are checked.
    [[nodiscard]] Status recordQueries(VkCommandBuffer commandBuffer, QueryPool& pool, const SuppleQueryDesc& desc);
    /// The surfaces of a group on the CPU, made when something first needs them.
    [[nodiscard]] static Result<std::shared_ptr<const CpuGroup>> surfacesOf(Group& group);
    /// ClipStream::request, if the asset's clips are streamed.
    [[nodiscard]] Status requestClip(Asset& asset, const ClipRequest& request);
    /// Makes the group anew with another capacity, and those that follow it.
    [[nodiscard]] Status setCapacity(uint64_t group, uint32_t capacity);
    /// Puts a new version into the place of an asset, and makes its groups anew. If that fails nothing changes.
    [[nodiscard]] Status reloadAsset(uint64_t id, cage::Character character, uint64_t clipPoolBytes);
    [[nodiscard]] Status reloadAsset(uint64_t id, std::shared_ptr<const Prepared> prepared, uint64_t clipPoolBytes);
    /// Where the coordinates of the device begin.
    [[nodiscard]] const glm::dvec3& origin() const { return origin_; }
    /// From now on or, if the frame has recorded a group, from the next frame on.
    void setOrigin(const glm::dvec3& origin);
    [[nodiscard]] Result<uint64_t> createView(const SuppleViewDesc& desc);
    bool destroyView(uint64_t id);

    [[nodiscard]] Status startRecording(const SuppleRecordingDesc& desc);
    [[nodiscard]] Status stopRecording();
    // A call that has succeeded (runtime/recording/calls.h), for a recording. It stays so: if there is no memory for
    // notes, the recording ends.
    template <class C>
    void note(const C& call) noexcept;
    /// C{asset, its hash}.
    template <class C>
    void noteLoad(SuppleAsset asset) noexcept;
    /// Hands over what is recorded.
    void flushRecording() noexcept;
    [[nodiscard]] bool recordsHashes() const { return recording_ && recorder_->hasHashes(); }

    Timings timings;
    SlotMap<Asset> assets;
    SlotMap<Group> groups;
    SlotMap<View> views;
    SlotMap<PointSet> pointSets;
    SlotMap<QueryPool> queryPools;

private:
    /// Makes ready for the hashes of a recording.
    [[nodiscard]] Status makeHashes();
    struct AskedClip {
        uint64_t asset = 0;
        ClipRequest request;
    };
    /// What a recording that begins now has to know, as calls that bring it about.
    void noteState(Recorder& recorder, std::span<const AskedClip> asked) const;
    /// Hands the hashes of complete frames to the recording.
    void noteHashes(uint64_t completedFrame) noexcept;
    /// Calls note(Recorder&) if the context is being recorded.
    template <class F>
    void whileRecording(F&& note) noexcept;
    /// Calls keep(CallKeeper&) if recordings may begin late.
    template <class F>
    void whileKeeping(F&& keep) noexcept;
    /// There is no point in going on with the recording.
    void endRecording(const char* reason) noexcept;
    /// Why the frame cannot begin, if it cannot.
    [[nodiscard]] Status checkFrame(uint64_t frame, uint64_t completedFrame) const;
    [[nodiscard]] Status takeFrame(uint64_t frame, uint64_t completedFrame);
    /// For what needs a frame.
    [[nodiscard]] Status checkOpen(const char* function) const;
    /// Whether the open frame has a group recorded.
    [[nodiscard]] bool hasRecorded() const;
    /// Behind the frame that ends now: warns of groups that seem to be drawn and were never recorded.
    void warnOfUnrecorded();
    void retire(uint64_t completedFrame);
    // runtime/group_memory.cpp
    void fitMemory(); ///< the open frame has begun
    [[nodiscard]] Status fitMemory(Group& group);
    /// Its leader is destroyed: it can only be destroyed too.
    [[nodiscard]] bool isOrphan(const Group& group) const {
        return group.follows() && groups.at(group.leader()) == nullptr;
    }
    [[nodiscard]] Status prepareBounds(); ///< sees to it that the pass can be recorded
    template <class F>
    void forViews(F&& visit); ///< those too that only groups hold
    template <class F>
    void forMembers(F&& visit); ///< all that takes part in frames (gpu::FrameMember), those in flight too
    /// Resolves the handles and links the groups (Group::Link), or says what is wrong with one; null: there are none.
    [[nodiscard]] Result<Group*> linkGroups(const SuppleRecordDesc& desc, uint64_t call) const;
    [[nodiscard]] gpu::StaticCount newCount() const; ///< under uploading_
    /// Why a group that follows another cannot be recorded with those that the call has linked; null if it can.
    [[nodiscard]] const char* faultOfLeader(const Group& group, uint64_t call) const;
    /// Takes the group that `desc` follows into `shared`, and what it decides into `desc`.
    [[nodiscard]] Status follow(const Asset& asset, GroupShared& shared, SuppleGroupDesc& desc);
    [[nodiscard]] GroupShared sharedFor(std::shared_ptr<View> view);
    void tellNotes(const Group& group) const;
    void tellBuiltLate(Asset& asset) const;
    [[nodiscard]] Result<uint64_t> keep(Result<std::shared_ptr<Asset>> asset, uint64_t clipPoolBytes);
    [[nodiscard]] Status reload(uint64_t id, Result<std::shared_ptr<Asset>> made, uint64_t clipPoolBytes);
    template <class F>
    void forStreams(F&& visit) const; ///< visit(Asset&), if its clips are streamed; those too that only groups hold
    void streamClips(Asset& asset, uint64_t poolBytes) const; ///< Asset::streamClips, with a warning
    void planStreams();                                       ///< the open frame has begun
    /// Segments of the group's clips that the open frame copies; the bytes. `statics`: bytes of the group that have
    /// been recorded without a barrier behind them. Under uploading_.
    VkDeviceSize recordStream(VkCommandBuffer commandBuffer, Group& group, VkDeviceSize statics);
    /// Those of all groups, behind a barrier; whether there are any. Under uploading_.
    bool recordStreams(VkCommandBuffer commandBuffer);
    /// What is asked for of all assets.
    [[nodiscard]] std::vector<AskedClip> askedClips() const;
    void noteClips(Recorder& recorder, std::span<const AskedClip> asked) const;
    /// Asks for the same of another version of the asset. `clips`: by number before, the number then or kNone.
    void takeOverRequests(const Asset& before, Asset& asset, std::span<const uint32_t> clips);
    /// Lets all segments go, and asks for these.
    void restartStreams(std::span<const AskedClip> asked);
    /// Which groups are made anew, and how. Groups that follow them are made anew with them.
    struct Remaking {
        std::function<bool(uint64_t, const Group&)> wants; ///< asked of groups that follow none
        std::function<void(GroupRecipe&)> change;
        std::shared_ptr<Asset> asset; ///< null: they keep theirs
        const AssetMatch& match;
    };
    /// A group that takes the place of another, once all are made, and so its point sets. A set that is null is
    /// dropped.
    struct Remade {
        struct Points {
            uint64_t id = 0;
            std::shared_ptr<PointSet> set;
        };
        /// The group's part of a query pool.
        struct Queries {
            uint64_t pool = 0;
            std::shared_ptr<QueryGroup> group;
        };
        uint64_t id = 0;
        std::shared_ptr<Group> group;
        std::vector<Points> points;
        std::vector<Queries> queries;
    };
    /// Makes the sets of a group for the one that takes its place.
    [[nodiscard]] Status remakePoints(const Group& before, Remade& remade);
    /// `table`: null, and it is made anew.
    [[nodiscard]] Result<std::shared_ptr<PointSet>> remadeFor(Group& group, const PointSet& set,
                                                              PointTableBuffer table);
    /// With the pipeline of the format.
    [[nodiscard]] Result<PointKernels*> kernelsFor(const PointRecipe& recipe);
    void tellDropped(const Remade& remade) const;
    void replacePoints(const Remade& remade);
    void dropPoints(uint64_t group);
    // runtime/queries/context_queries.cpp
    /// `pieces`: null, and they are made anew.
    [[nodiscard]] Result<std::shared_ptr<QueryGroup>>
    queryGroup(const std::shared_ptr<Group>& group, std::shared_ptr<QueryPieces> pieces, const QueryBuffers& buffers);
    /// Makes a group's parts of query pools for the one that takes its place.
    [[nodiscard]] Status remakeQueries(const Group& before, Remade& remade);
    void replaceQueries(const Remade& remade);
    void dropQueries(uint64_t group);
    /// Notes which groups a batch asks.
    [[nodiscard]] Status askGroups(QueryPool& pool, const SuppleQueryDesc& desc) const;
    [[nodiscard]] Result<std::vector<Remade>> remake(const Remaking& remaking);
    [[nodiscard]] Status remake(const Remaking& remaking, uint64_t id, Group& group, std::vector<Remade>& remade);
    void replace(std::vector<Remade>& remade);
    /// What linked groups need in one recording. `ofGroup`: Group::passNeeds or earlyNeeds.
    [[nodiscard]] gpu::TaskNeeds taskNeeds(const Group* groups, const gpu::TaskNeeds& (Group::*ofGroup)() const) const;
    /// Room for what all groups record in the frame from now on, and `more`.
    [[nodiscard]] Status reserveTasks(uint64_t frame, const gpu::TaskNeeds& more);

    SuppleLogFunction log_ = nullptr;
    void* logUser_ = nullptr;
    uint32_t framesInFlight_ = 2;
    bool asyncCompute_ = false;
    QueueFamilies families_; ///< with asyncCompute_
    uint64_t frame_ = 0, completedFrame_ = 0;
    bool frameOpen_ = false;               ///< begun and not cancelled
    std::optional<uint64_t> refusedFrame_; ///< by suppleBeginFrame, since the last one that it took
    glm::dvec3 origin_{0.0}, nextOrigin_{0.0};
    uint32_t nextGeneration_ = 1;
    uint64_t groupsMade_ = 0;
    std::atomic<uint64_t> recordings_ = 0; ///< calls of record()
    std::atomic<bool> lost_ = false;
    uint32_t flags_ = 0;                      ///< SuppleContextFlags
    std::unique_ptr<CallKeeper> keeper_;      ///< null: recordings begin before anything is created
    std::atomic<bool> keeps_ = false;         ///< nothing was lost for want of memory
    std::unique_ptr<Recorder> recorder_;      ///< null: the context is not being recorded
    std::shared_ptr<StageHashes> hashes_;     ///< while a recording has them
    std::weak_ptr<StageHashes> groupsHashes_; ///< that groups bind, perhaps since an earlier recording
    std::atomic<bool> recording_ = false;
    CageStageTable stages_;
    std::unique_ptr<SharedKernels> kernels_;
    surface::Programs surface_;
    gpu::StaticBuffers pairs_;
    gpu::TaskRooms taskRooms_;
    mutable std::mutex uploading_; ///< static data is shared by groups that may be recorded at the same time
    gpu::Uploads uploads_;
    uint64_t clipStamp_ = 0;           ///< ClipRequest, of the last
    std::vector<Asset*> streams_;      ///< memory of planStreams
    mutable uint64_t statesAsked_ = 0; ///< gpu::StaticCount::number
    /// Destroyed by the host, perhaps still in flight. Frames that do not record a group may draw it all the same: so
    /// it is in use up to the frame in which it was destroyed.
    template <class T>
    struct Retired {
        std::shared_ptr<T> object;
        uint64_t lastFrame = 0; ///< 0: it was never recorded
    };
    template <class T>
    [[nodiscard]] Retired<T> retired(std::shared_ptr<T> object) const {
        const uint64_t last = object->lastRecordedFrame() > 0 ? frame_ : 0;
        return {std::move(object), last};
    }
    /// Room for `more` than there are: what is alive must find it when it is destroyed.
    template <class T>
    static void makeRoom(std::vector<Retired<T>>& list, size_t more) {
        if (list.capacity() < list.size() + more) {
            list.reserve(2 * (list.size() + more));
        }
    }
    std::vector<Retired<Group>> retired_;
    std::vector<Retired<View>> retiredViews_;
    std::vector<Retired<QueryPool>> retiredPools_;
};

template <class F>
void Context::whileRecording(F&& note) noexcept {
    if (!recording_.load(std::memory_order_relaxed)) {
        return;
    }
    try {
        note(*recorder_);
    } catch (const std::exception&) {
        endRecording("there is no memory for it");
    }
}

template <class F>
void Context::whileKeeping(F&& keep) noexcept {
    if (!keeps_.load(std::memory_order_relaxed)) {
        return;
    }
    try {
        keep(*keeper_);
    } catch (const std::exception&) {
        keeps_ = false;
    }
}

template <class C>
void Context::note(const C& call) noexcept {
    whileKeeping([&](CallKeeper& keeper) { keeper.keep(call); });
    whileRecording([&](Recorder& recorder) { recorder.note(call); });
}

template <class C>
void Context::noteLoad(SuppleAsset asset) noexcept {
    const std::shared_ptr<Asset> loaded = assets.find(asset.id);
    const std::shared_ptr<const Prepared>& version = loaded->prepared;
    whileKeeping([&](CallKeeper& keeper) { keeper.keepLoad(asset, version, loaded->clipPoolBytes); });
    whileRecording([&](Recorder& recorder) {
        recorder.note(C{asset, recorder.noteAsset(*version), loaded->clipPoolBytes});
    });
}

template <class F>
void Context::forViews(F&& visit) {
    views.forEach(visit);
    for (const Retired<View>& view : retiredViews_) {
        visit(*view.object);
    }
}

template <class F>
void Context::forStreams(F&& visit) const {
    const auto visitAsset = [&](Asset& asset) {
        if (asset.stream != nullptr) {
            visit(asset);
        }
    };
    assets.forEach(visitAsset);
    groups.forEach([&](const Group& group) { visitAsset(*group.sharedAsset()); });
}

template <class F>
void Context::forMembers(F&& visit) {
    visit(pairs_);
    groups.forEach(visit);
    forViews(visit);
    queryPools.forEach(visit);
    // What a group destroyed since then has uploaded may be its asset's, and serve groups to come.
    for (const Retired<Group>& group : retired_) {
        visit(*group.object);
    }
}

} // namespace supple::runtime
