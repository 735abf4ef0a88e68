// The kernel that lets vertices jiggle behind the deform pass (shaders/soft/jiggle.comp).
#pragma once

#include "gpu/dispatches.h"
#include "gpu/pipelines.h"
#include "shaders/shared/jiggle.h"
#include "skinning/skinning_mode.h"

namespace supple::skinning {

class JiggleKernels {
public:
    /// Both must outlive the kernels.
    [[nodiscard]] static Result<JiggleKernels> create(const gpu::Device& device, gpu::Pipelines& pipelines);
    /// Makes the pipeline of a mode, with or without morph targets, if it is not there: on any thread.
    [[nodiscard]] Result<gpu::Kernel> make(SkinningMode mode, bool morphs) const;
    /// The same for what is to be recorded.
    [[nodiscard]] Status prepare(SkinningMode mode, bool morphs);

    [[nodiscard]] const gpu::ComputeLayout& layout() const { return layout_; }
    /// One dispatch over the instances of a window that have steps or show some. What it needs must have been prepared.
    void record(gpu::Dispatches& dispatches, const gpu::BoundSet& set, SkinningMode mode,
                const shared::JigglePush& push) const;

private:
    const gpu::Device* device_ = nullptr;
    gpu::Pipelines* pipelines_ = nullptr;
    gpu::ComputeLayout layout_;
    gpu::Kernel kernels_[kSkinningModes][2]; ///< by mode, and whether there are morph targets
};

} // namespace supple::skinning
