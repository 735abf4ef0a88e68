#include "runtime/points/point_kernels.h"

#include "shaders/points_on_vertices_comp.h"
#include "shaders/points_stencils_comp.h"
#include "shaders/shared/specialization.h"

namespace supple::runtime {

using namespace supple::shared;

namespace {

static_assert(sizeof(PointPush) <= gpu::kPushConstantBytes && sizeof(VertexPointPush) <= gpu::kPushConstantBytes);
static_assert(SUPPLE_POINT_FRAME_48 == kPointFrame48 && SUPPLE_POINT_FRAME_64 == kPointFrame64 &&
              SUPPLE_POINT_VERTEX_16 == kPointVertex16 && SUPPLE_POINT_DERIVATIVES_32 == kPointDerivatives32);

constexpr const char* kKernelNames[] = {"supple points, 48 bytes", "supple points, 64 bytes", "supple points, vertices",
                                        "supple points, derivatives"};
/// Derivatives have no positions.
constexpr const char* kCopyNames[] = {"supple points on vertices, 48 bytes", "supple points on vertices, 64 bytes",
                                      "supple points on vertices, vertices"};

} // namespace

Result<PointKernels> PointKernels::create(const gpu::Device& device, gpu::Pipelines& pipelines) {
    const gpu::Binding bindings[] = {
        gpu::wideStorage(kPointTableBinding), gpu::narrowTexels(kPointTableTexelBinding),
        gpu::wideStorage(kPointCageBinding),  gpu::narrowTexels(kPointCageTexelBinding),
        gpu::storage(kPointBinding),          gpu::storage(kPointPastBinding),
        gpu::wideStorage(kInstanceBinding),   gpu::narrowTexels(kInstanceTexelBinding),
    };
    PointKernels made;
    made.device_ = &device;
    made.pipelines_ = &pipelines;
    Result<gpu::ComputeLayout> layout =
        gpu::ComputeLayout::ofShared(device, bindings, sizeof(PointPush), "supple points");
    if (!layout) {
        return layout.error();
    }
    made.layout_ = std::move(*layout);
    const gpu::Binding copied[] = {
        gpu::storage(kPointVertexBinding), gpu::storage(kVertexPointBinding),  gpu::storage(kPointBinding),
        gpu::storage(kPointPastBinding),   gpu::wideStorage(kInstanceBinding), gpu::narrowTexels(kInstanceTexelBinding),
    };
    layout = gpu::ComputeLayout::ofShared(device, copied, sizeof(VertexPointPush), "supple points on vertices");
    if (!layout) {
        return layout.error();
    }
    made.copyLayout_ = std::move(*layout);
    return made;
}

Status PointKernels::prepare(SupplePointFormat format) {
    const gpu::Constant constants[] = {{kVertexFormatConstant, static_cast<uint32_t>(format)}};
    const Result<gpu::Kernel> kernel = pipelines_->get(layout_, points_stencils_comp, constants, kKernelNames[format]);
    if (!kernel) {
        return kernel.error();
    }
    kernels_[format] = *kernel;
    return success();
}

Status PointKernels::prepareCopies(SupplePointFormat format) {
    const gpu::Constant constants[] = {{kVertexFormatConstant, static_cast<uint32_t>(format)}};
    const Result<gpu::Kernel> kernel =
        pipelines_->get(copyLayout_, points_on_vertices_comp, constants, kCopyNames[format]);
    if (!kernel) {
        return kernel.error();
    }
    copies_[format] = *kernel;
    return success();
}

void PointKernels::recordCopies(gpu::Dispatches& dispatches, const gpu::BoundSet& set, SupplePointFormat format,
                                const VertexPointPush& push) const {
    const uint64_t lanes = uint64_t{push.entryCount} * push.instanceCount;
    const uint64_t local = device_->mapping.localSize;
    dispatches.dispatch(copies_[format], set, push, (lanes + local - 1) / local);
}

void PointKernels::record(gpu::Dispatches& dispatches, const gpu::BoundSet& set, SupplePointFormat format,
                          const PointPush& push) const {
    const uint64_t lanes = uint64_t{push.pointCount} * push.instanceCount;
    const uint64_t local = device_->mapping.localSize;
    dispatches.dispatch(kernels_[format], set, push, (lanes + local - 1) / local);
}

} // namespace supple::runtime
