#include "skinning/jiggle_kernels.h"

#include "gpu/device.h"
#include "shaders/shared/deform.h"
#include "shaders/shared/specialization.h"
#include "shaders/soft_jiggle_comp.h"
#include "shaders/soft_jiggle_comp_MUSH.h"

namespace supple::skinning {

using namespace shared;

static_assert(sizeof(JigglePush) <= gpu::kPushConstantBytes);

Result<JiggleKernels> JiggleKernels::create(const gpu::Device& device, gpu::Pipelines& pipelines) {
    const gpu::Binding bindings[] = {
        gpu::wideStorage(kDeformTableBinding), gpu::narrowTexels(kDeformTableTexelBinding),
        gpu::wideStorage(kPoseBinding),        gpu::narrowTexels(kPoseTexelBinding),
        gpu::storage(kDeformedCageBinding),    gpu::wideStorage(kJiggleTableBinding),
        gpu::storage(kJiggleStateBinding),     gpu::narrowTexels(kJiggleTableTexelBinding),
        gpu::wideStorage(kJigglePlaceBinding), gpu::narrowTexels(kJigglePlaceTexelBinding),
        gpu::wideStorage(kInstanceBinding),    gpu::narrowTexels(kInstanceTexelBinding),
    };
    JiggleKernels made;
    made.device_ = &device;
    made.pipelines_ = &pipelines;
    Result<gpu::ComputeLayout> layout =
        gpu::ComputeLayout::ofShared(device, bindings, sizeof(JigglePush), "supple jiggle");
    if (!layout) {
        return layout.error();
    }
    made.layout_ = std::move(*layout);
    return made;
}

Result<gpu::Kernel> JiggleKernels::make(SkinningMode mode, bool morphs) const {
    const gpu::Constant constants[] = {{kMorphsConstant, uint32_t{morphs}},
                                       {kSkinningConstant, static_cast<uint32_t>(mode)}};
    const gpu::Spirv& code = isMush(mode) ? soft_jiggle_comp_MUSH : soft_jiggle_comp;
    return pipelines_->get(layout_, code, constants, "supple jiggle");
}

Status JiggleKernels::prepare(SkinningMode mode, bool morphs) {
    const Result<gpu::Kernel> kernel = make(mode, morphs);
    if (!kernel) {
        return kernel.error();
    }
    kernels_[static_cast<size_t>(mode)][morphs ? 1 : 0] = *kernel;
    return success();
}

void JiggleKernels::record(gpu::Dispatches& dispatches, const gpu::BoundSet& set, SkinningMode mode,
                           const JigglePush& push) const {
    const uint64_t lanes = uint64_t{push.vertexCount} * push.instanceCount;
    const uint64_t local = device_->mapping.localSize;
    dispatches.dispatch(kernels_[static_cast<size_t>(mode)][push.firstInfluences != 0 ? 1 : 0], set, push,
                        (lanes + local - 1) / local);
}

} // namespace supple::skinning
