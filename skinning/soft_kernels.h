// The kernels of what is soft, behind the deform pass (shaders/soft/).
#pragma once

#include "gpu/dispatches.h"
#include "gpu/pipelines.h"
#include "shaders/shared/soft.h"
#include "skinning/skinning_mode.h"

namespace supple::skinning {

enum class SoftKind { jiggle, cloth };

class SoftKernels {
public:
    /// Both must outlive the kernels.
    [[nodiscard]] static Result<SoftKernels> create(const gpu::Device& device, gpu::Pipelines& pipelines,
                                                    SoftKind kind);
    /// Makes the pipeline of a mode, with or without morph targets, if it is not there: on any thread.
    [[nodiscard]] Result<gpu::Kernel> make(SkinningMode mode, bool morphs) const;
    /// The same for what is to be recorded.
    [[nodiscard]] Status prepare(SkinningMode mode, bool morphs);

    [[nodiscard]] const gpu::ComputeLayout& layout() const { return layout_; }
    /// One dispatch over the instances of a window that have steps or show some. What it needs must have been prepared.
    void record(gpu::Dispatches& dispatches, const gpu::BoundSet& set, SkinningMode mode,
                const shared::SoftPush& push) const;

private:
    const gpu::Device* device_ = nullptr;
    gpu::Pipelines* pipelines_ = nullptr;
    SoftKind kind_ = SoftKind::jiggle;
    gpu::ComputeLayout layout_;
    gpu::Kernel kernels_[kSkinningModes][2]; ///< by mode, and whether there are morph targets
};

} // namespace supple::skinning
