#include "skinning/soft_kernels.h"

#include "gpu/device.h"
#include "shaders/shared/deform.h"
#include "shaders/shared/specialization.h"
#include "shaders/soft_cloth_comp.h"
#include "shaders/soft_cloth_comp_MUSH.h"
#include "shaders/soft_jiggle_comp.h"
#include "shaders/soft_jiggle_comp_MUSH.h"

namespace supple::skinning {

using namespace shared;

namespace {

static_assert(sizeof(SoftPush) <= gpu::kPushConstantBytes);
static_assert(16 * (kMostClothVertices + 2 * kMostClothColliders) + 4 * kClothSums <= 16 * 1024,
              "what every device has of workgroup memory");

struct SoftRow {
    const gpu::Spirv &spirv, &mush; ///< the second for delta mush
    const char* name;
    bool perWorkgroup; ///< a workgroup takes an item of an instance, else a lane does
};
const SoftRow& rowOf(SoftKind kind) {
    static const SoftRow rows[] = {{soft_jiggle_comp, soft_jiggle_comp_MUSH, "supple jiggle", false},
                                   {soft_cloth_comp, soft_cloth_comp_MUSH, "supple cloth", true}};
    return rows[static_cast<size_t>(kind)];
}

} // namespace

Result<SoftKernels> SoftKernels::create(const gpu::Device& device, gpu::Pipelines& pipelines, SoftKind kind) {
    const gpu::Binding bindings[] = {
        gpu::wideStorage(kDeformTableBinding), gpu::narrowTexels(kDeformTableTexelBinding),
        gpu::wideStorage(kPoseBinding),        gpu::narrowTexels(kPoseTexelBinding),
        gpu::storage(kDeformedCageBinding),    gpu::wideStorage(kSoftTableBinding),
        gpu::storage(kSoftStateBinding),       gpu::narrowTexels(kSoftTableTexelBinding),
        gpu::wideStorage(kSoftPlaceBinding),   gpu::narrowTexels(kSoftPlaceTexelBinding),
        gpu::wideStorage(kInstanceBinding),    gpu::narrowTexels(kInstanceTexelBinding),
    };
    SoftKernels made;
    made.device_ = &device;
    made.pipelines_ = &pipelines;
    made.kind_ = kind;
    Result<gpu::ComputeLayout> layout =
        gpu::ComputeLayout::ofShared(device, bindings, sizeof(SoftPush), rowOf(kind).name);
    if (!layout) {
        return layout.error();
    }
    made.layout_ = std::move(*layout);
    return made;
}

Result<gpu::Kernel> SoftKernels::make(SkinningMode mode, bool morphs) const {
    const gpu::Constant constants[] = {{kMorphsConstant, uint32_t{morphs}},
                                       {kSkinningConstant, static_cast<uint32_t>(mode)}};
    const SoftRow& row = rowOf(kind_);
    return pipelines_->get(layout_, isMush(mode) ? row.mush : row.spirv, constants, row.name);
}

Status SoftKernels::prepare(SkinningMode mode, bool morphs) {
    const Result<gpu::Kernel> kernel = make(mode, morphs);
    if (!kernel) {
        return kernel.error();
    }
    kernels_[static_cast<size_t>(mode)][morphs ? 1 : 0] = *kernel;
    return success();
}

void SoftKernels::record(gpu::Dispatches& dispatches, const gpu::BoundSet& set, SkinningMode mode,
                         const SoftPush& push) const {
    const uint64_t items = uint64_t{push.count} * push.instanceCount, local = device_->mapping.localSize;
    dispatches.dispatch(kernels_[static_cast<size_t>(mode)][push.firstInfluences != 0 ? 1 : 0], set, push,
                        rowOf(kind_).perWorkgroup ? items : (items + local - 1) / local);
}

} // namespace supple::skinning
