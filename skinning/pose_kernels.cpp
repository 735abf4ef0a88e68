#include "skinning/pose_kernels.h"

#include "gpu/device.h"
#include "shaders/pose_drivers_comp.h"
#include "shaders/pose_locals_comp.h"
#include "shaders/pose_locals_comp_ADDS.h"
#include "shaders/pose_locals_comp_ADDS_TRANSITIONS.h"
#include "shaders/pose_mix_comp.h"
#include "shaders/pose_modify_comp.h"
#include "shaders/pose_palette_comp.h"
#include "shaders/pose_roots_comp.h"
#include "shaders/pose_springs_comp.h"
#include "shaders/shared/specialization.h"

#include <algorithm>

namespace supple::skinning {
namespace {

using namespace shared;

static_assert(sizeof(PosePush) <= gpu::kPushConstantBytes);

/// Poses of rows, and of rows and rotations.
size_t kindOf(SkinningMode mode) {
    return skinningRow(mode).rotations ? 1 : 0;
}

} // namespace

Result<PoseKernels> PoseKernels::create(const gpu::Device& device, gpu::Pipelines& pipelines) {
    const gpu::Binding bindings[] = {
        gpu::wideStorage(kClipTableBinding),  gpu::narrowTexels(kClipTableTexelBinding),
        gpu::wideStorage(kStateBinding),      gpu::narrowTexels(kStateTexelBinding),
        gpu::wideStorage(kMaskBinding),       gpu::narrowTexels(kMaskTexelBinding),
        gpu::storage(kScratchPoseBinding),    gpu::narrowTexels(kScratchPoseTexelBinding),
        gpu::storage(kPosedBinding),          gpu::storage(kEndsBinding),
        gpu::narrowTexels(kEndsTexelBinding), gpu::storage(kSpringBinding),
        gpu::wideStorage(kInstanceBinding),   gpu::narrowTexels(kInstanceTexelBinding),
    };
    PoseKernels made;
    made.device_ = &device;
    made.pipelines_ = &pipelines;
    Result<gpu::ComputeLayout> layout = gpu::ComputeLayout::ofShared(device, bindings, sizeof(PosePush), "supple pose");
    if (!layout) {
        return layout.error();
    }
    made.layout_ = std::move(*layout);
    return made;
}

Result<PoseKernels::Kernels> PoseKernels::kernels(SkinningMode mode, PoseNeeds needs) const {
    const bool rotations = skinningRow(mode).rotations;
    const gpu::Constant constants[] = {
        {kWorkgroupRowsConstant, device_->mapping.wide ? kAffineElements * kWorkgroupNodes : 1},
        {kRotationsConstant, rotations ? VK_TRUE : VK_FALSE}};
    gpu::Pipelines::Batch batch(*pipelines_);
    Kernels found;
    found.locals[0] = batch.get(layout_, pose_locals_comp, {}, "supple pose, local matrices");
    found.locals[1] = batch.get(layout_, pose_locals_comp_ADDS, {}, "supple pose, local matrices, additive");
    found.locals[2] =
        batch.get(layout_, pose_locals_comp_ADDS_TRANSITIONS, {}, "supple pose, local matrices, transitions");
    found.roots = batch.get(layout_, pose_roots_comp, {}, "supple pose, roots");
    found.modifiers = batch.get(layout_, pose_modify_comp, {}, "supple pose, modifiers");
    found.palette = batch.get(layout_, pose_palette_comp, constants,
                              rotations ? "supple pose, palette with rotations" : "supple pose, palette");
    const gpu::Constant layout[] = {{kRotationsConstant, rotations ? VK_TRUE : VK_FALSE}};
    if (needs.mixes) {
        found.mix =
            batch.get(layout_, pose_mix_comp, layout,
                      rotations ? "supple pose, between palettes with rotations" : "supple pose, between palettes");
    }
    if (needs.drivers) {
        found.drivers = batch.get(layout_, pose_drivers_comp, {}, "supple pose, drivers");
    }
    if (needs.springs) {
        found.springs = batch.get(layout_, pose_springs_comp, {}, "supple pose, springs");
    }
    const Status made = batch.make();
    return made ? Result<Kernels>(found) : made.error();
}

Status PoseKernels::make(SkinningMode mode, PoseNeeds needs) const {
    const Result<Kernels> made = kernels(mode, needs);
    return made ? success() : made.error();
}

Status PoseKernels::prepare(SkinningMode mode, PoseNeeds needs) {
    const Result<Kernels> made = kernels(mode, needs);
    if (!made) {
        return made.error();
    }
    std::copy(std::begin(made->locals), std::end(made->locals), locals_);
    roots_ = made->roots;
    modifiers_ = made->modifiers;
    const size_t kind = kindOf(mode);
    palette_[kind] = made->palette;
    if (needs.mixes) {
        mix_[kind] = made->mix;
    }
    if (needs.drivers) {
        drivers_ = made->drivers;
    }
    if (needs.springs) {
        springs_ = made->springs;
    }
    return success();
}

void PoseKernels::record(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const PosePush& push,
                         const gpu::Kernel& kernel, uint64_t groups) const {
    dispatches.dispatch(kernel, set, push, groups);
}

void PoseKernels::recordLocals(gpu::Dispatches& dispatches, const gpu::BoundSet& set, Locals what,
                               const PosePush& push) const {
    const uint64_t items = uint64_t{push.nodeCount} + 1 + (push.morphCount + 3) / 4;
    const uint64_t local = device_->mapping.localSize;
    record(dispatches, set, push, locals_[static_cast<size_t>(what)], (items * push.instanceCount + local - 1) / local);
}

void PoseKernels::recordRoots(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const PosePush& push) const {
    const uint64_t local = device_->mapping.localSize;
    record(dispatches, set, push, roots_, (push.instanceCount + local - 1) / local);
}

void PoseKernels::recordModifiers(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const PosePush& push) const {
    const uint64_t local = device_->mapping.localSize;
    record(dispatches, set, push, modifiers_, (push.instanceCount + local - 1) / local);
}

void PoseKernels::recordDrivers(gpu::Dispatches& dispatches, const gpu::BoundSet& set, uint32_t quads,
                                const PosePush& push) const {
    const uint64_t local = device_->mapping.localSize;
    record(dispatches, set, push, drivers_, (uint64_t{quads} * push.instanceCount + local - 1) / local);
}

void PoseKernels::recordSprings(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const PosePush& push) const {
    const uint64_t local = device_->mapping.wide ? 1 : device_->mapping.localSize;
    record(dispatches, set, push, springs_, (push.instanceCount + local - 1) / local);
}

void PoseKernels::recordPalette(gpu::Dispatches& dispatches, const gpu::BoundSet& set, SkinningMode mode,
                                const PosePush& push) const {
    const uint64_t local = device_->mapping.wide ? 1 : device_->mapping.localSize;
    record(dispatches, set, push, palette_[kindOf(mode)], (push.instanceCount + local - 1) / local);
}

void PoseKernels::recordMix(gpu::Dispatches& dispatches, const gpu::BoundSet& set, SkinningMode mode,
                            const PosePush& push) const {
    const uint64_t place = skinningRow(mode).rotations ? 1 : 0; // the transform
    const uint64_t items = push.jointCount + place + (push.morphCount + 3) / 4;
    const uint64_t local = device_->mapping.localSize;
    record(dispatches, set, push, mix_[kindOf(mode)], (items * push.instanceCount + local - 1) / local);
}

} // namespace supple::skinning
