// The pass *points*: frames of surface points in deformed cages (shaders/points/stencils.comp), and positions of
// surface vertices for those that lie on them (shaders/points/on_vertices.comp).
#pragma once

#include "gpu/dispatches.h"
#include "gpu/pipelines.h"
#include "shaders/shared/points.h"
#include "supple/supple.h"

#include <array>

namespace supple::runtime {

class PointKernels {
public:
    /// Both must outlive the kernels.
    [[nodiscard]] static Result<PointKernels> create(const gpu::Device& device, gpu::Pipelines& pipelines);

    /// Makes the pipeline of a format, if it is not there.
    [[nodiscard]] Status prepare(SupplePointFormat format);
    [[nodiscard]] const gpu::ComputeLayout& layout() const { return layout_; }
    /// `set` is the window's. The format must have been prepared.
    void record(gpu::Dispatches& dispatches, const gpu::BoundSet& set, SupplePointFormat format,
                const shared::PointPush& push) const;
    // The same of what takes over vertices.
    [[nodiscard]] Status prepareCopies(SupplePointFormat format);
    [[nodiscard]] const gpu::ComputeLayout& copyLayout() const { return copyLayout_; }
    void recordCopies(gpu::Dispatches& dispatches, const gpu::BoundSet& set, SupplePointFormat format,
                      const shared::VertexPointPush& push) const;

private:
    const gpu::Device* device_ = nullptr;
    gpu::Pipelines* pipelines_ = nullptr;
    gpu::ComputeLayout layout_, copyLayout_;
    std::array<gpu::Kernel, shared::kPointFormats> kernels_, copies_; ///< by format
};

} // namespace supple::runtime
