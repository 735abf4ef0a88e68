// What a surface has on the device beside its tables and vertices: coefficients, scratch memory, and the descriptor
// sets that bind all of it.
#pragma once

#include "gpu/buffer_plan.h"
#include "gpu/static_buffers.h"
#include "runtime/culling/visibility.h"
#include "runtime/instance_listing.h"
#include "runtime/recorded_once.h"
#include "runtime/surface_sets.h"
#include "surface/scheme.h"

#include <array>
#include <functional>

namespace supple::runtime {

/// What surfaces are made from, of every instance.
struct SurfaceInput {
    gpu::PlannedBuffer cages;        ///< deformed, of all parts or of the piece
    gpu::PlannedBuffer creaseAlphas; ///< null if the character has no crease sets
};

/// Pools of coefficients that the groups of a view share, one a frame in turns if there is motion. Null: none.
using SharedPools = std::array<gpu::PlannedBuffer, 2>;

class SurfaceMemory {
public:
    /// All pointers must outlive it.
    struct Desc {
        const gpu::Device* device = nullptr;
        const surface::Programs* programs = nullptr;
        const gpu::StaticBuffers* pairs = nullptr;
        uint32_t capacity = 0; ///< instances
        bool inView = false;
        bool motion = false;  ///< two pools, which take turns
        bool patches = false; ///< SUPPLE_GROUP_PATCHES
        uint32_t patchCount = 0;
        uint32_t poolStride = 0, cageStride = 0; ///< of an instance, in elements (surface::Tables)
        SharedPools pools;                       ///< in the place of the group's own
        const SurfaceMemory* leader = nullptr;   ///< whose pools it reads and writes, by slot; null: it has its own
        uint32_t scratchStride = 0;              ///< 0: there is none
        bool sizesInScratch = false;             ///< of dispatches
    };
    void plan(const Desc& desc, gpu::BufferPlan& device);
    /// When the plan is carried out. The list must outlive it.
    void attach(const SurfaceInput& input, const InstanceListing& listing, const InstanceList& list);
    /// The buffers of the plan are gone, then they are there again: attach() once more.
    void detach() { clear_.forget(); }
    void attach();

    /// What differs by owner of the vertices: streams, scratch memory, the view's words.
    using BindOutput = std::function<void(const SurfaceSets::Which&, SetContents&)>;
    /// The sets of a program, over the tables in `tables`. Behind attach().
    [[nodiscard]] Status makeSets(SurfaceSets& target, const gpu::StaticBuffers& tables,
                                  const surface::Program& program, const BindOutput& bindOutput) const;

    [[nodiscard]] const gpu::PlannedBuffer& pool(uint32_t index) const { return pools_[index]; }
    [[nodiscard]] const gpu::PlannedBuffer& patches() const { return patches_; }
    [[nodiscard]] const gpu::PlannedBuffer& scratch() const { return scratch_; }
    [[nodiscard]] bool hasMotion() const { return pools_[1].buffer() != VK_NULL_HANDLE; }
    /// Pools of the view, in which instances have no place of their own.
    [[nodiscard]] bool sharesPools() const { return desc_.pools[0].buffer() != VK_NULL_HANDLE; }
    [[nodiscard]] bool ownsPools() const { return !sharesPools() && desc_.leader == nullptr; }
    /// Own pools. No result depends on coefficients that no stage writes, but kernels may load them.
    [[nodiscard]] ZeroedOnce& clear() { return clear_; }

private:
    void bindInput(const SurfaceSets::Which& which, const gpu::StaticBuffers& tables, SetContents& contents) const;

    Desc desc_;
    SurfaceInput input_; ///< the group's
    const InstanceListing* listing_ = nullptr;
    InstanceList list_;
    std::array<gpu::PlannedBuffer, 2> pools_;
    gpu::PlannedBuffer patches_, scratch_;
    ZeroedOnce clear_;
};

} // namespace supple::runtime
