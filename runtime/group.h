// The instances of one asset with one scheme: their poses on the CPU, their buffers and descriptor sets on the device.
#pragma once

#include "base/result.h"
#include "gpu/memory.h"
#include "gpu/static_buffers.h"
#include "runtime/asset.h"
#include "runtime/culling.h"
#include "runtime/instance_poses.h"
#include "runtime/instance_slots.h"
#include "runtime/playback.h"
#include "runtime/view.h"
#include "skinning/deform_pass.h"
#include "supple/supple.h"
#include "surface/passes.h"
#include "surface/shared_samples.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace supple::runtime {

/// What the group borrows from its context.
struct GroupShared {
    const gpu::Device* device = nullptr;
    skinning::DeformPass* deform = nullptr;
    skinning::PosePass* pose = nullptr; ///< for groups that play on the device
    surface::Passes* surface = nullptr;
    VkBuffer pairs = VK_NULL_HANDLE;
    VkDeviceSize pairBytes = 0;
    surface::BoundsPass* bounds = nullptr;             ///< for groups of views
    const surface::OcclusionPass* occlusion = nullptr; ///< for groups of views with occlusion
    std::shared_ptr<View> view;                        ///< of the description
    uint32_t framesInFlight = 2;
    uint32_t firstGeneration = 1; ///< of the instances
    bool handsOver = false;       ///< to another queue family: every output is written anew in every frame
};

class Group {
public:
    ~Group();
    [[nodiscard]] static Result<std::shared_ptr<Group>> create(const GroupShared& shared, std::shared_ptr<Asset> asset,
                                                               const SuppleGroupDesc& desc);

    [[nodiscard]] const Asset& asset() const { return *asset_; }
    [[nodiscard]] const surface::Tables& tables() const { return scheme_->tables; }
    [[nodiscard]] const SuppleGroupOutput& output() const { return output_; }
    /// Why the rate is not the one asked for, or empty.
    [[nodiscard]] const std::string& rateNote() const { return rateNote_; }
    [[nodiscard]] SupplePoseSource poseSource() const { return poseSource_; }

    [[nodiscard]] InstancePoses& poses() { return poses_; }  ///< SUPPLE_POSES_SET
    [[nodiscard]] Playback& playback() { return playback_; } ///< SUPPLE_POSES_PLAYBACK
    [[nodiscard]] InstanceSlots& slots() { return slots_; }
    [[nodiscard]] const InstanceSlots& slots() const { return slots_; }

    [[nodiscard]] Status setRate(uint32_t rate);
    /// May be null.
    [[nodiscard]] View* view() const { return view_.get(); }
    /// Groups of a view: its vertices are the view's, at real-valued levels; or they are the group's own, at one of
    /// several rates an instance (group_rates.cpp).
    [[nodiscard]] bool hasLevels() const { return view_ != nullptr && !hasRates(); }
    [[nodiscard]] bool hasRates() const { return !rates_.empty(); }
    /// Its vertices count in the view's budget.
    [[nodiscard]] bool isBudgeted() const { return hasLevels() || (hasRates() && view_->countsRates()); }

    // The passes of a frame; runtime/frame.cpp puts them in order, with the barriers between them. What the dispatches
    // of one pass need between them the pass records: facets of P_m, subdivision, levels of patches, places, motion.
    struct PassCost {
        uint64_t points = 0;
        uint64_t bytes = 0;    ///< 0: nothing was recorded,
        bool onDevice = false; ///< or the device alone knows both
    };
    /// Static tables and first-use clears. The caller sees to it that no other thread does the same: the asset's tables
    /// are shared.
    [[nodiscard]] bool staticsPending() const;
    VkDeviceSize recordStatics(VkCommandBuffer commandBuffer, uint64_t frame);
    /// This frame's poses, its list of instances and what to draw of them.
    PassCost recordUpload(VkCommandBuffer commandBuffer, uint64_t frame);
    PassCost recordAttributes(VkCommandBuffer commandBuffer); ///< nothing after the first time at a rate
    [[nodiscard]] bool attributesPending() const { return attributesPending_; }
    [[nodiscard]] bool plays() const { return poseSource_ == SUPPLE_POSES_PLAYBACK; }
    [[nodiscard]] bool movesRoots() const { return plays() && playback_.hasRoots(); }
    PassCost recordPose(VkCommandBuffer commandBuffer, Playback::Part part) const; ///< a barrier stands between parts
    [[nodiscard]] bool deforms() const { return poseSource_ != SUPPLE_POSES_CAGE_BUFFER; }
    PassCost recordDeform(VkCommandBuffer commandBuffer) const;
    PassCost recordStage(VkCommandBuffer commandBuffer, surface::Stage stage) const;
    [[nodiscard]] bool writesPatches() const { return output_.patchCoefficients.buffer != VK_NULL_HANDLE; }
    PassCost recordPatch(VkCommandBuffer commandBuffer) const;
    PassCost recordEvaluate(VkCommandBuffer commandBuffer) const;

    /// Groups of a view: bounds of the deformed cages, and after a barrier the list of those that are seen. In between,
    /// where `leastVertices` of all groups are more than the view's room, their sizes.
    [[nodiscard]] bool culls() const { return culling_.active(); }
    PassCost recordBounds(VkCommandBuffer commandBuffer) const;
    /// Behind the bounds, what the view's depth pyramid hides.
    [[nodiscard]] bool occludes() const { return culls() && visible_ > 0 && view_->depthPyramid().has_value(); }
    PassCost recordOcclusion(VkCommandBuffer commandBuffer);
    /// Of the instances listed.
    [[nodiscard]] uint64_t leastVertices() const {
        return isBudgeted() ? uint64_t{culling_.leastVertices()} * visible_ : 0;
    }
    void recordSizes(VkCommandBuffer commandBuffer) const { culling_.recordSizes(commandBuffer, visible_); }
    void recordReadback(VkCommandBuffer commandBuffer) const {
        view_->recordReadback(commandBuffer, culling_.list(), culling_.countOffset(),
                              {hasLevels() ? output_.patchCount : 0, isBudgeted() ? culling_.leastVertices() : 0});
    }
    PassCost recordSeen(VkCommandBuffer commandBuffer, uint32_t room) const;

    // Groups of a view: the levels of edges, then of patches, then, when the view has solved its budget, places.
    PassCost recordEdgeLevels(VkCommandBuffer commandBuffer) const;
    PassCost recordPatchLevels(VkCommandBuffer commandBuffer) const;
    PassCost recordPlaces(VkCommandBuffer commandBuffer) const;
    [[nodiscard]] bool writesLodAttributes() const;
    PassCost recordLodAttributes(VkCommandBuffer commandBuffer) const;
    /// A set that binds the view's words.
    [[nodiscard]] VkDescriptorSet anySet() const { return windows_.front().surface[pool_]; }
    [[nodiscard]] uint32_t priorities() const { return slots_.priorities(); }

    /// Previous positions; its scratch memory is evaluation's, so a barrier stands between the two.
    [[nodiscard]] bool writesMotion() const;
    [[nodiscard]] bool usesScratch() const;
    PassCost recordMotion(VkCommandBuffer commandBuffer) const;

    /// What a frame hands from the compute to the draw queue family: buffers written in every frame, and those written
    /// in this one.
    using Transfers = std::array<VkBufferMemoryBarrier2, 11>;
    [[nodiscard]] uint32_t transfers(Transfers& out) const;

    /// The last frame that has the group's passes, and the last that has anything of it.
    [[nodiscard]] uint64_t passesFrame() const { return passesFrame_; }
    [[nodiscard]] uint64_t lastRecordedFrame() const { return lastRecordedFrame_; }
    void cancelFrame(uint64_t frame);
    void releaseStaging(uint64_t completedFrame);

private:
    struct SurfaceSets {
        std::array<VkDescriptorSet, 2> surface{}; ///< by pool
        std::array<VkDescriptorSet, 2> motion{};  ///< by pool, writing previous positions
    };
    /// Instances that a descriptor can reach: windowSize_ slots, the last window fewer.
    struct Window : SurfaceSets {
        VkDescriptorSet deform = VK_NULL_HANDLE;
        uint32_t index = 0;
    };
    /// A rate that instances of a view's group may have. Its vertices lie in the instance's behind the coarser rates'.
    struct Rate {
        std::shared_ptr<SchemeTables> scheme;
        surface::Evaluation evaluation;
        std::vector<SurfaceSets> windows;
    };
    Status layOutWindows(const SuppleGroupDesc& desc);
    Status createBuffers(const SuppleGroupDesc& desc, std::span<const uint16_t> indices);
    Status createStatics(std::span<const std::byte> indices);
    Status createPlayback();
    Status createSets();
    void layOutDraws();
    [[nodiscard]] std::vector<uint16_t> layOutGrids(); ///< their indices
    Status createRates(const surface::Recipe& recipe);
    [[nodiscard]] uint64_t layOutVertices(); ///< of an instance
    void fillRates();
    [[nodiscard]] std::vector<Culling::Rate> cullingRates() const;
    [[nodiscard]] uint32_t ownVertices(size_t rate) const; ///< of an instance at this one of rates_
    void recordRates(VkCommandBuffer commandBuffer, bool previous) const;
    /// All tables of the group, once.
    template <class F>
    void forSchemes(F&& visit) const;
    /// Of a flag as groups have it, and as views do.
    [[nodiscard]] bool wants(const SuppleGroupDesc& desc, uint32_t groupFlag, uint32_t viewFlag) const;
    void fillOutput();
    [[nodiscard]] VkDeviceSize surfaceBytes() const;    ///< an instance
    [[nodiscard]] VkDeviceSize poseUploadBytes() const; ///< a frame in flight
    [[nodiscard]] VkDeviceSize listUploadBytes() const;
    [[nodiscard]] VkDeviceSize cullUploadBytes() const; ///< lists and draws, when they change
    template <class F>
    void forWindows(F&& record) const;
    /// The same with what surface passes are recorded with.
    template <class F>
    void forSurfaceWindows(F&& record) const;
    /// Of a pass over the visible instances, or where the view culls over those of them that it sees.
    [[nodiscard]] PassCost costOfSeen(uint64_t points, uint64_t bytes) const;
    [[nodiscard]] shared::LodPush levelPush(const Window& window) const;
    [[nodiscard]] VkDeviceSize levelArguments(const surface::Window& window) const;
    Status createCulling();
    [[nodiscard]] surface::LodWindow lodWindow(const Window& window, VkDescriptorSet set) const;
    [[nodiscard]] uint32_t scratchElements() const; ///< an instance

    GroupShared shared_;
    std::shared_ptr<Asset> asset_;
    std::shared_ptr<SchemeTables> scheme_;
    SupplePoseSource poseSource_ = SUPPLE_POSES_SET;
    uint32_t capacity_ = 0;
    bool anyRate_ = false;   ///< the scheme's tables serve all rates
    uint32_t askedRate_ = 0; ///< when it was created
    uint32_t maxRate_ = 0;
    uint32_t vertexCount_ = 0; ///< surface vertices an instance, without padding
    surface::Evaluation evaluation_;
    std::vector<Rate> rates_; ///< rising, the last one's tables being scheme_; empty for groups of one rate, of levels
    std::shared_ptr<View> view_;
    uint32_t firstRun_ = 0; ///< in the view; all windows one after the other
    bool hasRuns_ = false;  ///< or is counted by the view without any
    bool oneLevel_ = false; ///< an instance, instead of one an edge
    Culling culling_;

    InstancePoses poses_;
    InstanceSlots slots_;
    Playback playback_;

    gpu::BufferSet buffers_;    ///< see the enumeration in group_buffers.h
    gpu::BufferSet staging_;    ///< poses; lists and draws: each one run a frame in flight
    gpu::StaticBuffers static_; ///< grid indices
    gpu::DescriptorPoolHandle deformPool_, surfacePool_;
    gpu::TexelViews views_;
    uint32_t windowSize_ = 0;
    std::vector<Window> windows_;
    std::vector<InstanceSlots::Listed> listed_; ///< by window, of the frame being recorded
    uint32_t visible_ = 0;
    uint32_t listRun_ = 0;     ///< of the staging memory: the newest lists and draws
    bool drawsChanged_ = true; ///< since they were written there
    uint32_t pool_ = 0;        ///< the coefficient pool of the newest frame; motion has two

    struct Grid {
        uint32_t firstIndex = 0, indexCount = 0;
    };
    std::vector<std::array<Grid, surface::kDomainCount>> grids_; ///< by rate - 1, or of rates_, or the one
    surface::SharedMesh mesh_; ///< shared samples: until it lies in the staging memory and the draws are laid out
    SuppleGroupOutput output_{};
    std::vector<SuppleDrawRange> drawRanges_; ///< what output_ points to
    std::vector<SuppleRate> rateOutputs_;
    std::vector<SuppleLodDraw> lodDraws_;
    std::string rateNote_;
    bool cleared_ = false;
    bool attributesPending_ = false;
    bool indicesToRelease_ = false; ///< uploaded, and not yet handed to the draw queue family
    // Frames that did these:
    uint64_t clearedFrame_ = 0, indicesReleaseFrame_ = 0, attributesFrame_ = 0;
    uint64_t passesFrame_ = 0, lastRecordedFrame_ = 0;
};

template <class F>
void Group::forSchemes(F&& visit) const {
    visit(*scheme_);
    for (const Rate& rate : rates_) {
        if (rate.scheme != scheme_) {
            visit(*rate.scheme);
        }
    }
}

} // namespace supple::runtime
