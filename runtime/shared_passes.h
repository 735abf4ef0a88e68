// Passes that a context has once, each made when something first needs it.
#pragma once

#include "runtime/culling/bounds_pass.h"
#include "runtime/culling/occlusion_pass.h"
#include "skinning/pose_pass.h"

#include <memory>
#include <mutex>

namespace supple::runtime {

/// Any threads may use it at the same time. A pass stays where it is once it is there. It comes with its layouts alone:
/// making one keeps no other thread waiting for pipelines.
class SharedPasses {
public:
    /// Both must outlive the passes.
    SharedPasses(const gpu::Device& device, gpu::Pipelines& pipelines) : device_(&device), pipelines_(&pipelines) {}

    /// Of instances that play on the device.
    [[nodiscard]] Result<skinning::PosePass*> pose() { return made(pose_); }
    /// Of views, and of groups with bounds.
    [[nodiscard]] Result<BoundsPass*> bounds() { return made(bounds_); }
    /// Of views with occlusion.
    [[nodiscard]] Result<OcclusionPass*> occlusion() { return made(occlusion_); }

    // The same; null: nothing has needed it.
    [[nodiscard]] skinning::PosePass* knownPose() const { return known(pose_); }
    [[nodiscard]] BoundsPass* knownBounds() const { return known(bounds_); }
    [[nodiscard]] OcclusionPass* knownOcclusion() const { return known(occlusion_); }

private:
    template <class Pass>
    [[nodiscard]] Pass* known(const std::unique_ptr<Pass>& pass) const {
        const std::scoped_lock lock(mutex_);
        return pass.get();
    }
    template <class Pass>
    [[nodiscard]] Result<Pass*> made(std::unique_ptr<Pass>& pass) {
        const std::scoped_lock lock(mutex_);
        if (pass == nullptr) {
            Result<Pass> created = Pass::create(*device_, *pipelines_);
            if (!created) {
                return created.error();
            }
            pass = std::make_unique<Pass>(std::move(*created));
        }
        return pass.get();
    }

    const gpu::Device* device_;
    gpu::Pipelines* pipelines_;
    mutable std::mutex mutex_;
    std::unique_ptr<skinning::PosePass> pose_;
    std::unique_ptr<BoundsPass> bounds_;
    std::unique_ptr<OcclusionPass> occlusion_;
};

} // namespace supple::runtime
