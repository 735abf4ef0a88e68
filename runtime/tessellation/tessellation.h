// How a surface of a group becomes vertices: one implementation a file.
//
//   none.cpp          the deformed cage alone
//   fixed_rate.cpp    grids of samples, patch by patch, at one rate
//   direct.cpp        grids without vertices: the host evaluates them while it draws
//   indexed_mesh.cpp  one mesh an instance, which stores the samples on borders once
//   levels.cpp        a view's vertices, at real-valued levels
//   rates.cpp         groups of a view whose instances have one of several rates each (subdivision)
#pragma once

#include "gpu/buffer_plan.h"
#include "gpu/tasks.h"
#include "runtime/culling/culling.h"
#include "runtime/instance_set.h"
#include "runtime/recorded_once.h"
#include "runtime/recording/stage_hashes.h"
#include "runtime/tessellation/built_surface.h"
#include "runtime/tessellation/surface_memory.h"
#include "runtime/vertex_streams.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace supple::runtime {

/// Surface vertices of an instance start on a multiple of this, so that descriptor offsets are aligned to 256 bytes
/// (VkPhysicalDeviceLimits) in every stream: 12, 16 or 24 bytes each.
inline constexpr uint32_t kVertexPadding = 64;

/// The index buffer of a surface. The surface of a group that is made anew takes it over if it has the same indices.
struct SharedIndices {
    /// 0: the indices that are drawn. 1, of grids that are traced: those of a whole instance.
    std::shared_ptr<gpu::StaticBuffers> buffers;
    RecordedOnce release; ///< to the queue family that draws
};

/// The base class has what all have in common: what is built (BuiltSurface), what lies on the device (SurfaceMemory),
/// and the recording of the program.
class Tessellation : public gpu::FrameMembers {
public:
    /// Builds the tables, prepares the pipelines and lays out an instance; refuses what the scheme cannot take.
    [[nodiscard]] static Result<std::unique_ptr<Tessellation>> create(const TessellationDesc& desc);
    virtual ~Tessellation() = default;
    Tessellation(const Tessellation&) = delete;
    Tessellation& operator=(const Tessellation&) = delete;

    [[nodiscard]] const SchemeTables& scheme() const { return *built_.scheme; }
    [[nodiscard]] const surface::Tables& tables() const { return built_.tables(); }
    [[nodiscard]] SuppleScheme schemeId() const { return desc_.group.scheme; }
    [[nodiscard]] const std::vector<uint32_t>& parts() const { return desc_.parts; }
    /// Those parts; null: all of the asset's.
    [[nodiscard]] AssetPiece* piece() const { return desc_.piece.get(); }
    /// The scheme polygons, which is not tessellated.
    [[nodiscard]] bool isMesh() const {
        return kind() != SUPPLE_TESSELLATION_NONE && surface::schemeOf(scheme().recipe().scheme).isMesh();
    }
    /// How far the surface may lie outside the box of its cage, as a part of the box's size.
    [[nodiscard]] float boundsMargin() const {
        return kind() == SUPPLE_TESSELLATION_NONE ? 0.0f
                                                  : surface::schemeOf(scheme().recipe().scheme).boundsMargin(cage());
    }
    /// Why the rate is not the one asked for, or empty.
    [[nodiscard]] const std::string& rateNote() const { return built_.rateNote; }
    /// Why texture coordinates are linear though the file says otherwise, or empty.
    [[nodiscard]] const std::string& uvNote() const { return built_.uvNote; }

    // Creation, in this order, after create().
    /// Rates that instances of a group may have. `first`: segments along an edge of the cage; each further one has
    /// twice as many.
    struct Ladder {
        uint32_t first = 0, count = 0;
        bool adapts = false; ///< it is right for whatever rates the group's other surfaces have
    };
    /// None (a count of 0) if instances do not have one of several rates.
    [[nodiscard]] virtual Ladder ladder() const { return {}; }
    /// The group's, if ladder() has rates.
    virtual void setLadder(Ladder /*ladder*/) {}
    [[nodiscard]] virtual BoundBytes boundBytes() const;
    /// `byWindows`: the host draws the windows that passes have. Otherwise the device must be able to bind what draws
    /// read as a whole.
    [[nodiscard]] virtual Status cutDraws(InstanceWindows& windows, bool byWindows);
    /// Joins the view; asks it for room.
    [[nodiscard]] virtual Status join(const InstanceWindows& /*windows*/) { return success(); }
    /// Groups of a view.
    [[nodiscard]] virtual Culling::Surface culledSurface() const { return {}; }
    virtual void plan(gpu::BufferPlan& device, gpu::BufferPlan& staging);
    /// When the plans are carried out. `visibility` is the group's Culling if it belongs to a view.
    [[nodiscard]] virtual Status createSets(const SurfaceInput& input, const InstanceListing& listing,
                                            const Visibility& visibility);

    // The planned buffers may be given back (runtime/surface_buffers.h).
    /// Nothing is recorded until takeBuffers(). Frames in flight may still use buffers and sets.
    void giveBuffers() { hasBuffers_ = false; }
    void takeBuffers() { hasBuffers_ = true; }
    /// No frame uses the sets any more, and the buffers are about to be freed.
    virtual void freeSets();
    /// Before takeBuffers(), if the buffers are new ones.
    [[nodiscard]] virtual Status remakeSets();
    [[nodiscard]] bool hasBuffers() const { return hasBuffers_; }

    [[nodiscard]] virtual gpu::MemoryUse memoryUse() const { return {}; } ///< beside the planned buffers
    /// What its passes need in a frame.
    [[nodiscard]] virtual gpu::TaskNeeds taskNeeds() const { return taskNeedsOf(program_); }
    void recordWarmUp(VkCommandBuffer commandBuffer) const override;
    // Output; the API asks for what a tessellation of this kind has.
    [[nodiscard]] virtual SuppleTessellation kind() const = 0;
    /// Null without surface vertices.
    [[nodiscard]] virtual const VertexStreams* streams() const { return nullptr; }
    virtual void fillGrid(SuppleGridOutput& /*output*/) const {}
    /// SUPPLE_GROUP_RAY_TRACING: hosts build acceleration structures from it.
    [[nodiscard]] bool isTraced() const { return (desc_.group.flags & SUPPLE_GROUP_RAY_TRACING) != 0; }
    /// If isTraced().
    virtual void fillRays(SuppleRayGeometry& /*output*/) const {}
    virtual void fillLevels(SuppleLevelOutput& /*output*/) const {}
    virtual void fillDirect(SuppleDirectOutput& /*output*/) const {}
    [[nodiscard]] const gpu::PlannedBuffer& patchCoefficients() const { return memory_.patches(); }
    /// Segments along a patch edge that the surface vertices of all instances have now. 0: there are none at a rate.
    [[nodiscard]] virtual uint32_t gridRate() const { return 0; }
    /// The vertices of a patch, by its samples at a gridRate(). Empty: the surface never has that rate.
    [[nodiscard]] virtual std::vector<uint32_t> verticesOf(uint32_t /*patch*/, uint32_t /*rate*/) const { return {}; }
    /// Null if the index buffer is not its own.
    [[nodiscard]] virtual const SharedIndices* indices() const { return nullptr; }
    virtual void addTransfers(Transfers& transfers, uint64_t frame) const;
    /// Makes ready for another rate, or says why it cannot. Until takeRate() nothing else changes.
    [[nodiscard]] virtual Status prepareRate(uint32_t rate) = 0;
    /// What prepareRate() made ready. The next fillGrid() tells of it.
    virtual void takeRate() {}

    /// In a frame that leaves the group out: its indirect draws draw nothing until a frame records it.
    virtual void recordNoDraws(VkCommandBuffer /*commandBuffer*/) {}

    // The passes of a frame. Those that take a command buffer record themselves what their dispatches need between
    // them.
    /// Records a pass in rounds, of this surface alone: calls record(round) for each.
    template <class Record>
    void inRounds(gpu::Dispatches& dispatches, Record&& record) const {
        surface::inRounds(dispatches, std::forward<Record>(record));
    }
    /// Whether it reads coefficients that the surface of a followed group constructs.
    [[nodiscard]] bool sharesCoefficients() const { return leader_ != nullptr; }
    /// It constructs them itself in the coming frame. True: it did not in the last one, or the other way round.
    bool setConstructs(bool constructs) { return std::exchange(constructs_, constructs) != constructs; }
    /// Which of the two pools of coefficients the newest frame writes.
    [[nodiscard]] uint32_t pool() const { return pool_; }
    /// How far the origin of the coordinates has moved since the group's last recording.
    void setPastStep(const glm::vec3& step) { pastStep_ = step; }
    /// `changed`: the list of instances has.
    virtual VkDeviceSize recordUpload(VkCommandBuffer commandBuffer, uint64_t frame, bool changed);
    [[nodiscard]] virtual bool attributesDue() const { return false; }
    virtual PassCost recordAttributes(gpu::Dispatches& /*dispatches*/, uint64_t /*frame*/) { return {}; }
    [[nodiscard]] bool has(surface::Stage stage) const { return !stepsOf(stage).empty(); }
    PassCost recordStage(surface::Round& round, surface::Stage stage) const;
    [[nodiscard]] bool writesPatches() const { return memory_.patches().buffer() != VK_NULL_HANDLE; }
    PassCost recordPatch(gpu::Dispatches& dispatches) const;
    // Groups of a view, in this order; the view solves its budget before places.
    virtual PassCost recordEdgeLevels(surface::Round& /*round*/) const { return {}; }
    virtual PassCost recordPatchLevels(gpu::Dispatches& /*dispatches*/) const { return {}; }
    [[nodiscard]] bool findsDepths() const { return !program_.depths.empty(); }
    virtual PassCost recordDepths(gpu::Dispatches& /*dispatches*/) const { return {}; }
    virtual PassCost recordPlaces(gpu::Dispatches& /*dispatches*/) const { return {}; }
    [[nodiscard]] bool deepens() const { return !program_.deepen.empty(); }
    virtual PassCost recordDeepen(surface::Round& /*round*/) const { return {}; }
    [[nodiscard]] virtual bool writesLevelAttributes() const { return false; }
    virtual PassCost recordLevelAttributes(gpu::Dispatches& /*dispatches*/) const { return {}; }
    virtual PassCost recordEvaluate(surface::Round& round) const = 0;
    [[nodiscard]] bool writesTangents() const { return built_.outputs.streams.has(Stream::tangents); }
    /// Previous positions.
    [[nodiscard]] bool writesMotion() const { return memory_.hasMotion(); }
    /// Evaluation and motion write the same memory, so that a barrier stands between the two.
    [[nodiscard]] virtual bool usesScratch() const { return memory_.scratch().buffer() != VK_NULL_HANDLE; }
    virtual PassCost recordMotion(surface::Round& round) const = 0;

    // What a recording hashes of the surface: positions.
    [[nodiscard]] virtual uint32_t hashedParts() const { return 1; }
    [[nodiscard]] virtual HashedPart hashedPart(uint32_t part) const = 0;
    /// Whether the vertices count in the view's budget.
    [[nodiscard]] virtual bool isBudgeted() const { return false; }
    /// How many vertices an instance has at its coarsest.
    [[nodiscard]] virtual uint32_t leastVertices() const { return 0; }
    /// What the view's statistics count of an instance that is seen: patches at levels.
    [[nodiscard]] virtual uint32_t patchesAtLevels() const { return 0; }

protected:
    explicit Tessellation(TessellationDesc desc);

    /// Builds the tables of the description; `rate` in segments along an edge of the cage.
    [[nodiscard]] Status buildTables();
    [[nodiscard]] surface::ProgramOptions programOptions() const { return programOptionsOf(desc_, built_); }
    [[nodiscard]] Status prepare();
    /// The passes of tables at a rate or at levels.
    [[nodiscard]] Result<surface::Program> programFor(const surface::Tables& tables,
                                                      const surface::ProgramOptions& options,
                                                      const surface::Evaluation& evaluation) const;
    [[nodiscard]] Status checkVertices(uint64_t vertices) const;
    /// Whether the device can bind what a window that draws have holds: `bytes` per instance.
    [[nodiscard]] Status checkBinding(const InstanceWindows& windows, VkDeviceSize bytes, const char* what) const;
    [[nodiscard]] Status checkRate(uint32_t rate, uint32_t most) const;
    /// Null without a view.
    [[nodiscard]] View* view() const { return desc_.view.get(); }
    [[nodiscard]] const InstanceWindows& windows() const { return listing_->windows(); }
    /// What the surface is made of: its piece, or all of the asset's cage.
    [[nodiscard]] const cage::Cage& cage() const { return desc_.asset->cageOf(desc_.piece); }

    /// The instances of a window with the sets that passes of this frame bind.
    [[nodiscard]] surface::Window seen(uint32_t window) const;
    [[nodiscard]] const surface::Sets& sets(uint32_t window) const { return sets_.at({window, pool_, false}); }
    /// Sets that write previous positions, from the coefficients of the frame before.
    [[nodiscard]] const surface::Sets& pastSets(uint32_t window) const { return sets_.at({window, 1 - pool_, true}); }
    [[nodiscard]] const surface::Sets& todaysSets(uint32_t window) const { return sets_.at({window, pool_, true}); }
    /// A window whose previous positions are evaluated.
    [[nodiscard]] surface::Window ofPast(surface::Window window) const {
        window.push.pastX = pastStep_.x;
        window.push.pastY = pastStep_.y;
        window.push.pastZ = pastStep_.z;
        return window;
    }
    void recordWarmUp(VkCommandBuffer commandBuffer, const surface::Program& program, const SurfaceSets& sets) const;
    [[nodiscard]] gpu::TaskNeeds taskNeedsOf(const surface::Program& program) const;
    [[nodiscard]] Status makeSets(SurfaceSets& target, const SchemeTables& scheme,
                                  const surface::Program& program) const;
    /// Positions of these vertices, of whichever instances.
    [[nodiscard]] static HashedPart hashedPositions(const VertexStreams& streams);
    /// What differs by owner of the vertices: streams, scratch memory, the view's words.
    virtual void bindOutput(const SurfaceSets::Which& which, SetContents& contents) const = 0;
    /// The pools of the view if its groups share them; else null.
    [[nodiscard]] virtual SharedPools sharedPools() const { return {}; }
    /// Elements of an instance.
    [[nodiscard]] virtual uint32_t scratchStride() const { return program_.scratchStride; }

    // Every recording looks at these, so they stand first.
    uint32_t pool_ = 0; ///< of the newest frame
    glm::vec3 pastStep_{0.0f};
    bool hasBuffers_ = true, constructs_ = true;
    const Tessellation* leader_ = nullptr; ///< which shares its coefficients, as long as its group is there

    TessellationDesc desc_;
    BuiltSurface built_;
    surface::Evaluation evaluation_;
    surface::Program program_;
    const InstanceListing* listing_ = nullptr;
    const Visibility* visibility_ = nullptr;
    SurfaceMemory memory_;
    SurfaceSets sets_;

private:
    /// Whether the leader's coefficients can be its own.
    [[nodiscard]] bool fits(const Tessellation& leader) const;
    [[nodiscard]] const surface::Steps& stepsOf(surface::Stage stage) const;
};

/// A tessellation that begin() has laid out, or why it cannot be.
template <class T>
[[nodiscard]] Result<std::unique_ptr<Tessellation>> begun(std::unique_ptr<T> made) {
    const Status status = made->begin();
    if (!status) {
        return status.error();
    }
    return std::unique_ptr<Tessellation>(std::move(made));
}

// The implementations, for Tessellation::create().
[[nodiscard]] std::unique_ptr<Tessellation> makeNoTessellation(const TessellationDesc& desc);
[[nodiscard]] Result<std::unique_ptr<Tessellation>> makeFixedRate(const TessellationDesc& desc);
[[nodiscard]] Result<std::unique_ptr<Tessellation>> makeDirect(const TessellationDesc& desc);
[[nodiscard]] Result<std::unique_ptr<Tessellation>> makeIndexedMesh(const TessellationDesc& desc);
[[nodiscard]] Result<std::unique_ptr<Tessellation>> makeLevels(const TessellationDesc& desc);
[[nodiscard]] Result<std::unique_ptr<Tessellation>> makeRates(const TessellationDesc& desc);

} // namespace supple::runtime
