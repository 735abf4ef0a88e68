#include "skinning/deform_kernels.h"

#include "shaders/deform_deform_comp.h"
#include "shaders/deform_deform_comp_MUSH.h"
#include "shaders/deform_gather_comp.h"
#include "shaders/shared/specialization.h"

#include <cstring>

namespace supple::skinning {
namespace {

using namespace shared;

static_assert(sizeof(DeformPush) <= gpu::kPushConstantBytes);
static_assert(sizeof(Affine) == 48);

constexpr size_t kElementBytes = 16;

/// transform * joint, both affine.
Affine placed(const glm::mat4& transform, const Affine& joint) {
    Affine result;
    for (int row = 0; row < 3; ++row) {
        result.rows[row] =
            transform[0][row] * joint.rows[0] + transform[1][row] * joint.rows[1] + transform[2][row] * joint.rows[2];
        result.rows[row].w += transform[3][row];
    }
    return result;
}

} // namespace

PoseLayout PoseLayout::of(SkinningMode mode, uint32_t jointCount, uint32_t morphCount) {
    PoseLayout layout{mode, jointCount, morphCount, 0, 0};
    layout.morphWeights =
        layout.hasRotations() ? kRotationTransform + kRotationElements * jointCount : kLinearElements * jointCount;
    layout.stride = layout.elements();
    return layout;
}

void writePose(const PoseLayout& layout, const InstancePose& pose, std::byte* target) {
    const auto put = [&target](const void* source, size_t bytes) {
        if (bytes > 0) { // an empty list has no address to copy from
            std::memcpy(target, source, bytes);
        }
        target += bytes;
    };
    if (layout.hasRotations()) {
        const Affine transform = toAffine(pose.transform);
        put(&transform, sizeof(transform));
        for (size_t j = 0; j < pose.palette.size(); ++j) {
            put(&pose.palette[j], sizeof(Affine));
            put(&pose.rotations[j], sizeof(glm::vec4));
        }
    } else if (pose.transform == glm::mat4(1.0f)) {
        put(pose.palette.data(), pose.palette.size_bytes());
    } else {
        for (const Affine& own : pose.palette) {
            const Affine joint = placed(pose.transform, own);
            put(&joint, sizeof(joint));
        }
    }
    put(pose.morphWeights.data(), layout.morphCount * sizeof(float));
    std::memset(target, 0, (layout.stride - layout.morphWeights) * kElementBytes - layout.morphCount * sizeof(float));
}

Result<DeformKernels> DeformKernels::create(const gpu::Device& device, gpu::Pipelines& pipelines) {
    const gpu::Binding bindings[] = {
        gpu::wideStorage(kDeformTableBinding),    gpu::narrowTexels(kDeformTableTexelBinding),
        gpu::wideStorage(kPoseBinding),           gpu::narrowTexels(kPoseTexelBinding),
        gpu::storage(kDeformedCageBinding),       gpu::wideStorage(kInstanceBinding),
        gpu::narrowTexels(kInstanceTexelBinding),
    };
    DeformKernels made;
    made.device_ = &device;
    made.pipelines_ = &pipelines;
    Result<gpu::ComputeLayout> layout =
        gpu::ComputeLayout::ofShared(device, bindings, sizeof(DeformPush), "supple deform");
    if (!layout) {
        return layout.error();
    }
    made.layout_ = std::move(*layout);
    return made;
}

Result<gpu::Kernel> DeformKernels::make(SkinningMode mode, bool morphs) const {
    const uint32_t t = uint32_t{morphs};
    const gpu::Constant constants[] = {{kMorphsConstant, t}, {kSkinningConstant, static_cast<uint32_t>(mode)}};
    const gpu::Spirv& code = isMush(mode) ? deform_deform_comp_MUSH : deform_deform_comp;
    return pipelines_->get(layout_, code, constants, skinningRow(mode).kernels[t]);
}

Result<gpu::Kernel> DeformKernels::makeGather() const {
    return pipelines_->get(layout_, deform_gather_comp, {}, "supple gather");
}

Status DeformKernels::prepare(SkinningMode mode, bool morphs) {
    const Result<gpu::Kernel> kernel = make(mode, morphs);
    if (!kernel) {
        return kernel.error();
    }
    kernels_[static_cast<size_t>(mode)][morphs ? 1 : 0] = *kernel;
    return success();
}

Status DeformKernels::prepareGather() {
    const Result<gpu::Kernel> kernel = makeGather();
    if (!kernel) {
        return kernel.error();
    }
    gather_ = *kernel;
    return success();
}

void DeformKernels::record(gpu::Dispatches& dispatches, const gpu::BoundSet& set, SkinningMode mode,
                           const shared::DeformPush& push) const {
    record(dispatches, kernels_[static_cast<size_t>(mode)][push.firstInfluences != 0 ? 1 : 0], set, push);
}

void DeformKernels::recordGather(gpu::Dispatches& dispatches, const gpu::BoundSet& set,
                                 const shared::DeformPush& push) const {
    record(dispatches, gather_, set, push);
}

void DeformKernels::record(gpu::Dispatches& dispatches, const gpu::Kernel& kernel, const gpu::BoundSet& set,
                           const shared::DeformPush& push) const {
    const uint64_t lanes = uint64_t{push.vertexCount} * push.instanceCount;
    const uint64_t local = device_->mapping.localSize;
    dispatches.dispatch(kernel, set, push, (lanes + local - 1) / local);
}

} // namespace supple::skinning
