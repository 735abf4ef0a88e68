// What a query pool has of one group: the pieces of its surfaces, and the sets that its kernels bind.
#pragma once

#include "gpu/bound_sets.h"
#include "gpu/buffer_plan.h"
#include "gpu/static_buffers.h"
#include "runtime/instance_listing.h"
#include "runtime/queries/query_kernels.h"
#include "runtime/queries/query_pieces.h"
#include "runtime/queries/query_tree.h"
#include "runtime/surfaces.h"

#include <cstdint>
#include <memory>

namespace supple::runtime {

/// The pieces on the device.
struct QueryPieces {
    gpu::StaticBuffers table;
    std::vector<FacePieces> ofFaces;
    uint32_t count = 0;
    float reach = 0.0f;
    uint32_t firstLeaf = 0; ///< element of the table (addLeaves); 0: there are none

    [[nodiscard]] static Result<std::shared_ptr<QueryPieces>> create(const gpu::Device& device, PieceTable table);
    /// How many elements of a table the device binds.
    [[nodiscard]] static uint64_t mostElements(const gpu::Device& device);
};

/// Where a group's instances are. What it points to must outlive the QueryGroup.
struct QuerySource {
    const gpu::Device* device = nullptr;
    const InstanceListing* listing = nullptr;
    VkBuffer cages = VK_NULL_HANDLE; ///< deformed, of all instances
    uint32_t cageStride = 0;         ///< vertices
    uint32_t vertexCount = 0;        ///< of a cage
    const Surfaces* surfaces = nullptr;
    std::shared_ptr<const void> keeper; ///< of the listing
};
/// The buffers of the pool.
struct QueryBuffers {
    VkBuffer rays = VK_NULL_HANDLE, best = VK_NULL_HANDLE, hits = VK_NULL_HANDLE;
    uint32_t rayCount = 0; ///< of a frame, at most

    /// More rays than a lane looks at go through trees.
    [[nodiscard]] bool areMany() const { return rayCount > shared::kRaysPerLane; }
};

class QueryGroup {
public:
    /// Kernels must outlive it.
    [[nodiscard]] static Result<std::shared_ptr<QueryGroup>> create(QuerySource source, const QueryKernels& kernels,
                                                                    std::shared_ptr<QueryPieces> pieces,
                                                                    const QueryBuffers& buffers);
    /// What frames upload once.
    template <class F>
    void forStatics(F&& visit) const {
        visit(pieces_->table);
        visit(*triangles_);
    }
    [[nodiscard]] bool staticsPending() const {
        return pieces_->table.staticsPending() || triangles_->staticsPending();
    }

    [[nodiscard]] const std::shared_ptr<QueryPieces>& pieces() const { return pieces_; }
    /// How many lanes its largest frame has, which own a hit by number.
    [[nodiscard]] uint64_t mostLanes() const;

    /// What all windows of a batch have in common, and what is counted over them.
    struct Batch {
        uint32_t rayCount = 0;
        uint32_t group = 0;         ///< its number in the pool
        uint32_t firstLane = 0;     ///< of the group
        bool writesMisses = false;  ///< its first window does
        bool isEmpty = false;       ///< no instance of it takes part
        uint32_t firstTriangle = 0; ///< hits of triangles, among the rays
        uint32_t rate = 1;          ///< of the group's grids and meshes
    };
    /// How many lanes look at pieces in the frame that is recorded.
    [[nodiscard]] uint32_t lanes() const;
    void recordBoxes(gpu::Dispatches& dispatches, const Batch& batch) const;
    /// Which instances rays are aimed at, then their list. What is behind works on these alone.
    void recordAim(gpu::Dispatches& dispatches, const Batch& batch) const;
    void recordList(gpu::Dispatches& dispatches, const Batch& batch) const;
    void recordPick(gpu::Dispatches& dispatches, const Batch& batch, uint32_t work) const;
    /// How often trees are made in turn until all instances have had one; 0: the pool is for few rays.
    [[nodiscard]] uint32_t turns() const { return tree_ != nullptr ? tree_->plan().turns * windowCount() : 0; }
    void recordTree(gpu::Dispatches& dispatches, const Batch& batch, TreeKernels::Pass pass, uint32_t turn) const;
    void recordFinish(gpu::Dispatches& dispatches, const Batch& batch) const;
    // The same of places whose nearest points are asked for.
    void recordNearest(gpu::Dispatches& dispatches, const Batch& batch, uint32_t work) const;
    void recordNearestFinish(gpu::Dispatches& dispatches, const Batch& batch) const;
    /// Hits of triangles, over misses.
    void recordRefine(gpu::Dispatches& dispatches, const Batch& batch) const;

    /// Null: the pool is for few rays.
    [[nodiscard]] const QueryTree* tree() const { return tree_.get(); }

private:
    [[nodiscard]] Status createBuffers();
    [[nodiscard]] Status createTree();
    [[nodiscard]] Status createSets(const QueryBuffers& buffers);
    [[nodiscard]] uint32_t windowCount() const { return source_.listing->windows().count(); }
    /// Dispatches whose sizes a window's list writes.
    [[nodiscard]] uint32_t dispatchesEach() const {
        return 1 + (tree_ != nullptr ? shared::kTreeDispatches * tree_->plan().turns : 0);
    }
    /// Calls record(set, push) for each window, also for those without instances.
    template <class F>
    void forWindows(const Batch& batch, F&& record) const;

    QuerySource source_;
    const QueryKernels* kernels_ = nullptr;
    std::shared_ptr<QueryPieces> pieces_;
    gpu::BufferSet boxes_; ///< and what is listed of them
    std::unique_ptr<QueryTree> tree_;
    std::unique_ptr<gpu::StaticBuffers> triangles_; ///< triangleFaces()
    gpu::TexelViews views_;
    gpu::BoundSets sets_; ///< by window
};

} // namespace supple::runtime
