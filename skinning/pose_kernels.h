// The pose pass: what instances play, sampled, layered and put together on the device into the poses that the deform
// pass reads.
#pragma once

#include "gpu/dispatches.h"
#include "gpu/pipelines.h"
#include "shaders/shared/pose.h"
#include "skinning/clip_table.h"
#include "skinning/deform_kernels.h"

namespace supple::skinning {

/// What a group needs of the pose pass beside what all do. Code that no one runs costs time on CPU devices, so kernels
/// leave out what is not needed.
struct PoseNeeds {
    bool mixes = false;   ///< update rates: what lies between two poses
    bool steps = false;   ///< springs or soft vertices: each of their steps is posed
    bool springs = false; ///< some joints swing
    bool drivers = false; ///< morph weights follow from joints
    bool morphs = false;  ///< poses have morph weights
    ClipKinds clips;
};

/// The pipelines of a group.
class PosePipelines {
public:
    [[nodiscard]] const gpu::ComputeLayout& layout() const { return *layout_; }
    /// What locals can do: the second if some instance has an additive layer, the third if one is in a transition.
    enum class Locals { blend, add, transition };
    static constexpr size_t kLocals = 3;
    /// Each records one dispatch over a window of instances; a barrier stands between each two. Roots only where one
    /// has root motion.
    void recordLocals(gpu::Dispatches& dispatches, const gpu::BoundSet& set, Locals what,
                      const shared::PosePush& push) const;
    void recordRoots(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::PosePush& push) const;
    /// Only where one has modifiers.
    void recordModifiers(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::PosePush& push) const;
    /// Only in groups with springs. `push.instanceCount`: how many swing.
    void recordSprings(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::PosePush& push) const;
    /// Only in groups with drivers: `quads` of morph weights, of which each is added to. Before springs.
    void recordDrivers(gpu::Dispatches& dispatches, const gpu::BoundSet& set, uint32_t quads,
                       const shared::PosePush& push) const;
    void recordPalette(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::PosePush& push) const;
    /// Only in groups with update rates: what is shown between ends.
    void recordMix(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const shared::PosePush& push) const;

private:
    friend class PoseKernels;
    const gpu::Device* device_ = nullptr;
    const gpu::ComputeLayout* layout_ = nullptr;
    bool rotations_ = false; ///< poses are rows and rotations, else rows
    gpu::Kernel locals_[kLocals];
    gpu::Kernel roots_, modifiers_, drivers_, springs_, palette_, mix_;
};

class PoseKernels {
public:
    /// Both must outlive the pass.
    [[nodiscard]] static Result<PoseKernels> create(const gpu::Device& device, gpu::Pipelines& pipelines);
    /// Makes what is not there: on any thread, also beside recording. This must outlive the result.
    [[nodiscard]] Result<PosePipelines> make(SkinningMode mode, const PoseNeeds& needs) const;

private:
    const gpu::Device* device_ = nullptr;
    gpu::Pipelines* pipelines_ = nullptr;
    gpu::ComputeLayout layout_;
};

} // namespace supple::skinning
