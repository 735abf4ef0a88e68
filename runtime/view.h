// A camera's level of detail: its budget and the buffers that the groups it sees share (shaders/shared/lod.h).
#pragma once

#include "gpu/buffer_plan.h"
#include "gpu/static_buffers.h"
#include "runtime/recorded_once.h"
#include "runtime/vertex_streams.h"
#include "shaders/shared/bounds.h"
#include "shaders/shared/lod.h"
#include "shaders/shared/surface.h"
#include "supple/supple.h"
#include "surface/programs.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace supple::runtime {

/// What the pool of a view is given away by.
inline constexpr VkDeviceSize kPoolUnitBytes = shared::kPoolUnit * gpu::kVec4Bytes;

class Culling;

class View final : public gpu::FrameMembers {
public:
    /// `passes` must outlive the view.
    [[nodiscard]] static Result<std::shared_ptr<View>> create(const gpu::Device& device, surface::Programs& passes,
                                                              uint32_t framesInFlight, const SuppleViewDesc& desc);

    [[nodiscard]] const SuppleViewDesc& desc() const { return desc_; }
    [[nodiscard]] bool culls() const { return (desc_.flags & SUPPLE_VIEW_CULL) != 0; }
    [[nodiscard]] bool leavesBackFaces() const { return (desc_.flags & SUPPLE_VIEW_BACK_FACES) != 0; }
    void setCamera(const SuppleCameraDesc& camera); ///< as checked by the caller
    /// As checked by the caller; nothing: nothing hides.
    void setDepthPyramid(const std::optional<SuppleDepthPyramidDesc>& pyramid);
    [[nodiscard]] const std::optional<SuppleDepthPyramidDesc>& depthPyramid() const { return pyramid_; }
    /// Changes whenever the pyramid is set: image views may come again under the same handle.
    [[nodiscard]] uint64_t pyramidGeneration() const { return pyramidGeneration_; }
    [[nodiscard]] shared::CullView cullView() const;
    /// In the coordinates surfaces come out in.
    [[nodiscard]] shared::LodCamera lodCamera() const;
    /// The same for the passes that choose levels: if back faces are left out, an orthographic camera's position is the
    /// direction it looks in.
    [[nodiscard]] shared::LodCamera levelCamera() const;
    /// Vertices of the budget that patches can have; the rest is for what fills up draw instances.
    [[nodiscard]] uint32_t room() const;
    /// The same for a frame's groups; kRoomForAll if even all instances fit at their coarsest, their coefficients too.
    [[nodiscard]] uint32_t roomInFrame() const { return roomInFrame_; }
    /// Adds what one of the frame's groups needs at most; its number among them.
    [[nodiscard]] uint32_t addNeeds(uint64_t vertices, uint64_t poolUnits) {
        verticesNeeded_ += vertices;
        poolUnitsNeeded_ += poolUnits;
        return groupsInFrame_++;
    }
    /// Behind addNeeds() of all.
    void findRoom();
    /// A group is recorded in this call of suppleRecord. True: it is the first of the view.
    [[nodiscard]] bool enter(uint64_t call) { return std::exchange(call_, call) != call; }
    [[nodiscard]] bool hasCamera() const { return hasCamera_; }

    /// The pools of coefficients that groups with levels share, of so many units (shared::kPoolUnit). 0: they have
    /// pools of their own.
    [[nodiscard]] uint32_t poolUnits() const { return poolUnits_; }
    [[nodiscard]] const std::array<gpu::PlannedBuffer, 2>& pools() const { return pools_; }
    /// That which the newest recording writes. With motion they take turns.
    [[nodiscard]] uint32_t pool() const { return pool_; }
    /// The last recording before the newest one.
    [[nodiscard]] uint64_t recordedBefore() const { return recordedBefore_; }

    /// A group's windows take runs when it is created and give them back when it goes. The runs of `windows` windows,
    /// one after the other, each as `lod` lists them; patch ranges r of a window evaluate as dispatch firstRun + r.
    /// `doubleSided`: by run of a window.
    [[nodiscard]] Result<uint32_t> takeRuns(const surface::LodTables& lod, const std::vector<bool>& doubleSided,
                                            uint32_t windows);
    void giveRuns(uint32_t first, uint32_t count);
    [[nodiscard]] uint32_t maxRuns() const { return static_cast<uint32_t>(takenRuns_.size()); }
    /// Where the indirect arguments of a dispatch lie among the words, in bytes.
    [[nodiscard]] VkDeviceSize dispatchOffset(uint32_t dispatch) const;
    /// The same for groups without runs, of which there may be as many as runs, too. False: the view is full.
    /// `vertices`: of all its instances at all rates, which in all groups together 32 bits must count.
    [[nodiscard]] bool takeGroup(uint64_t vertices);
    void giveGroup(uint64_t vertices);
    /// Whether vertices of such groups count in the budget.
    [[nodiscard]] bool countsRates() const { return groupsWithoutRuns_ > 0 && camera_.vertexBudget > 0; }

    VkDeviceSize recordUpload(VkCommandBuffer commandBuffer, uint64_t frame);
    void recordWarmUp(VkCommandBuffer commandBuffer) const override;
    [[nodiscard]] gpu::MemoryUse memoryUse() const;
    /// `priorities`: bits of those that instances have.
    void recordSolve(VkCommandBuffer commandBuffer, uint32_t priorities) const;
    struct SolvedGroup {
        uint32_t patches = 0;       ///< of an instance
        uint32_t leastVertices = 0; ///< of the budget that an instance has at its coarsest
        uint32_t unposed = 0;       ///< instances that were left out before they were posed
    };
    /// Copies what the solver found out to where the host reads it frames later; then, for each of its groups, how many
    /// instances were seen.
    void recordReadback(VkCommandBuffer commandBuffer);
    void recordReadback(VkCommandBuffer commandBuffer, const Culling& culling, SolvedGroup group);
    /// Behind those of all groups.
    void recordCounts(VkCommandBuffer commandBuffer) const;
    void beginFrame(uint64_t completedFrame) override;
    void cancelFrame(uint64_t frame) override;
    /// What the frame hands over with the first of its groups. Of the words only those that hosts read: the others must
    /// keep what is in them from frame to frame.
    void addTransfers(Transfers& transfers, uint64_t frame) const;
    /// All draws of groups with levels become none, in a frame that leaves out all groups of the view.
    void recordNoDraws(VkCommandBuffer commandBuffer, uint64_t frame);
    /// Of the newest completed frame; frame 0: none has.
    [[nodiscard]] const SuppleViewStatistics& statistics() const { return newest_; }
    /// Of a frame that is completed and whose place no other has taken yet, as from beginFrame on until the next
    /// recording; nothing where the view was not recorded in it.
    [[nodiscard]] std::optional<SuppleViewStatistics> statisticsOf(uint64_t completedFrame) const;
    [[nodiscard]] uint64_t lastRecordedFrame() const { return recordedFrame_; }

    [[nodiscard]] const VertexStreams& streams() const { return streams_; }
    [[nodiscard]] VkBuffer words() const { return words_.buffer(); } ///< shaders/shared/lod.h
    [[nodiscard]] VkDeviceSize wordBytes() const { return words_.size(); }
    [[nodiscard]] VkBuffer cull() const { return cull_.buffer(); }   ///< shared::CullView
    [[nodiscard]] VkBuffer sizes() const { return sizes_.buffer(); } ///< of instances (shaders/shared/bounds.h)
    /// Fills in where output.drawCount draws of a group are, whose runs begin at `firstRun`.
    void fillDraws(SuppleLevelOutput& output, uint32_t firstRun) const;

private:
    [[nodiscard]] Status createBuffers();
    /// Behind all other buffers of the plan. `indexBytes`: of grids.
    [[nodiscard]] Status planPools(gpu::BufferPlan& plan, VkDeviceSize indexBytes);
    /// The bytes of each pool of coefficients, if all other buffers take `others` and the device can bind `most`.
    [[nodiscard]] Result<VkDeviceSize> poolBytes(VkDeviceSize others, VkDeviceSize most, uint32_t pools) const;
    [[nodiscard]] Status createMapped();               ///< for uploads, and for what the host reads
    [[nodiscard]] std::vector<uint16_t> layOutGrids(); ///< their indices; the host's words say where each grid is
    [[nodiscard]] Status createSolver(surface::Programs& passes);
    [[nodiscard]] uint32_t budget() const;
    /// Counts of all groups lie behind the sizes. Otherwise each group has its own.
    [[nodiscard]] bool countsOfView() const;
    [[nodiscard]] VkDeviceSize uploadBytes() const; ///< of a frame, with all runs that there may be
    [[nodiscard]] VkDeviceSize readbackBytes() const;
    [[nodiscard]] VkDeviceSize recordOffset() const; ///< where records begin among the words

    const gpu::Device* device_ = nullptr;
    uint32_t framesInFlight_ = 2;
    SuppleViewDesc desc_{};
    SuppleCameraDesc camera_{};
    bool hasCamera_ = false;
    std::optional<SuppleDepthPyramidDesc> pyramid_;
    uint64_t pyramidGeneration_ = 0;

    gpu::BufferSet buffers_;
    gpu::PlannedBuffer words_, cull_, sizes_;
    std::array<gpu::PlannedBuffer, 2> pools_;
    uint32_t poolUnits_ = 0, pool_ = 0;
    VertexStreams streams_;
    surface::Programs::Solver solver_;
    gpu::DescriptorPoolHandle descriptorPool_;
    gpu::TexelViews views_;
    VkDescriptorSet solverSet_ = VK_NULL_HANDLE;
    gpu::BufferSet staging_;  ///< the host's part of the words, and the view to cull by, a run a frame in flight
    gpu::BufferSet readback_; ///< solutions, one a frame in flight
    gpu::StaticBuffers static_;
    std::vector<uint32_t> hostWords_; ///< up to kLodSolution
    std::vector<uint32_t> runWords_;
    std::vector<bool> takenRuns_;
    uint32_t endOfRuns_ = 0;
    uint32_t groupsWithoutRuns_ = 0;
    uint64_t verticesWithoutRuns_ = 0;
    uint32_t forms_ = 0; ///< bits of those that runs have
    ZeroedOnce clear_;   ///< of histograms, which the solver clears from then on
    RecordedOnce indicesRelease_;
    RecordedOnce noDraws_; ///< due: the last frame of the view may have left draws
    uint32_t roomInFrame_ = shared::kRoomForAll;
    uint64_t verticesNeeded_ = 0, poolUnitsNeeded_ = 0;
    uint64_t call_ = 0;
    uint32_t groupsInFrame_ = 0;
    uint64_t recordedFrame_ = 0, recordedBefore_ = 0;
    struct Solved {
        uint64_t frame = 0;
        uint32_t groups = 0;
        std::vector<SolvedGroup> of; ///< room for all groups, those with runs and without
    };
    [[nodiscard]] SuppleViewStatistics read(size_t place) const; ///< of solved_

    std::vector<Solved> solved_; ///< by place in readback_
    SuppleViewStatistics newest_{};
};

} // namespace supple::runtime
