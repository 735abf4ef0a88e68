// Kernels that a context has once, each made when something first needs it.
#pragma once

#include "runtime/culling/bounds_kernels.h"
#include "runtime/culling/occlusion_kernels.h"
#include "runtime/points/point_kernels.h"
#include "runtime/queries/query_kernels.h"
#include "runtime/recording/stage_hashes.h"
#include "skinning/pose_kernels.h"

#include <memory>
#include <mutex>

namespace supple::runtime {

/// Any threads may use it at the same time. A pass stays where it is once it is there. It comes with its layouts alone:
/// making one keeps no other thread waiting for pipelines.
class SharedKernels {
public:
    /// Both must outlive the passes.
    SharedKernels(const gpu::Device& device, gpu::Pipelines& pipelines) : device_(&device), pipelines_(&pipelines) {}

    /// For instances that play on the device.
    [[nodiscard]] Result<skinning::PoseKernels*> pose() { return made(pose_); }
    /// For views, and for groups with bounds.
    [[nodiscard]] Result<BoundsKernels*> bounds() { return made(bounds_); }
    /// For views with occlusion.
    [[nodiscard]] Result<OcclusionKernels*> occlusion() { return made(occlusion_); }
    /// For groups with point sets.
    [[nodiscard]] Result<PointKernels*> points() { return made(points_); }
    /// For query pools.
    [[nodiscard]] Result<QueryKernels*> queries() { return made(queries_); }
    /// For recordings with hashes.
    [[nodiscard]] Result<HashKernels*> hashes() { return made(hashes_); }

    // The same; null: nothing has needed it.
    [[nodiscard]] skinning::PoseKernels* knownPose() const { return known(pose_); }
    [[nodiscard]] BoundsKernels* knownBounds() const { return known(bounds_); }
    [[nodiscard]] OcclusionKernels* knownOcclusion() const { return known(occlusion_); }

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
    std::unique_ptr<skinning::PoseKernels> pose_;
    std::unique_ptr<BoundsKernels> bounds_;
    std::unique_ptr<OcclusionKernels> occlusion_;
    std::unique_ptr<PointKernels> points_;
    std::unique_ptr<QueryKernels> queries_;
    std::unique_ptr<HashKernels> hashes_;
};

} // namespace supple::runtime
