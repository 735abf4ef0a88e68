// Bounds of the instances of a group that belongs to no view: the bounds pass of views
// (runtime/culling/bounds_kernels.h) without a camera.
#pragma once

#include "base/result.h"
#include "gpu/bound_sets.h"
#include "gpu/buffer_plan.h"
#include "runtime/culling/bounds_kernels.h"
#include "runtime/instance_windows.h"
#include "runtime/pass_cost.h"
#include "runtime/recorded_once.h"
#include "supple/supple.h"

#include <vector>

namespace supple::runtime {

/// Recording allocates nothing.
class ListedBounds final : public gpu::FrameMembers {
public:
    struct Desc {
        const gpu::Device* device = nullptr;
        const BoundsKernels* kernels = nullptr;
        const InstanceWindows* windows = nullptr; ///< must outlive this, as all here
        uint32_t cageVertices = 0, cageStride = 0;
        float margin = 0.0f; ///< how far surfaces may lie outside the box of their cage, as a part of its size
    };
    explicit ListedBounds(const Desc& desc) : desc_(desc) {}
    void plan(gpu::BufferPlan& device);
    /// When the plan is carried out. `list`: all visible instances of the group by slot, capacity entries.
    [[nodiscard]] Status createSets(VkBuffer cages, VkBuffer list);

    PassCost record(gpu::Dispatches& dispatches) const;

    [[nodiscard]] SuppleBufferRange bounds() const; ///< by slot, as of Culling

private:
    Desc desc_;
    gpu::PlannedBuffer bounds_;
    gpu::PlannedBuffer rest_; ///< what the pass reads and writes for views: a view that sees everything, and states
    ZeroedOnce clear_;        ///< of rest_: a view of zeros has no planes and no limits, and levels are 0
    gpu::TexelViews views_;
    gpu::BoundSets sets_; ///< by window
};

} // namespace supple::runtime
