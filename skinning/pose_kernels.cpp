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
#include <iterator>

namespace supple::skinning {
namespace {

using namespace shared;

static_assert(sizeof(PosePush) <= gpu::kPushConstantBytes);

VkBool32 constantOf(bool value) {
    return value ? VK_TRUE : VK_FALSE;
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

Result<PosePipelines> PoseKernels::make(SkinningMode mode, const PoseNeeds& needs) const {
    PosePipelines made;
    made.device_ = device_;
    made.layout_ = &layout_;
    made.rotations_ = skinningRow(mode).rotations;
    const uint32_t rows = device_->mapping.wide ? kAffineElements * kWorkgroupNodes : 1;
    const bool all = device_->mapping.sharesDispatches; // groups of all kinds share those of one kernel
    const gpu::Constant listed{kListedConstant, constantOf(all || needs.mixes || needs.steps)};
    const gpu::Constant rotations{kRotationsConstant, constantOf(made.rotations_)};
    const gpu::Constant ofClips[] = {listed,
                                     {kKeyedClipsConstant, constantOf(all || needs.clips.keyed)},
                                     {kPackedClipsConstant, constantOf(all || needs.clips.packed)},
                                     {kCoarseTwinsConstant, constantOf(all || needs.clips.coarse)}};
    gpu::Constant ofLocals[std::size(ofClips) + 1];
    *std::copy(std::begin(ofClips), std::end(ofClips), ofLocals) = {kMorphsConstant, constantOf(all || needs.morphs)};
    const gpu::Constant ofPalette[] = {listed, rotations, {kWorkgroupRowsConstant, rows}};
    const std::span ofLists(&listed, 1), ofMix(&rotations, 1);
    gpu::Pipelines::Batch batch(*pipelines_);
    const auto get = [&](const gpu::Spirv& spirv, std::span<const gpu::Constant> constants, const char* name) {
        return batch.get(layout_, spirv, constants, name);
    };
    made.locals_[0] = get(pose_locals_comp, ofLocals, "supple pose, local matrices");
    made.locals_[1] = get(pose_locals_comp_ADDS, ofLocals, "supple pose, local matrices, additive");
    made.locals_[2] = get(pose_locals_comp_ADDS_TRANSITIONS, ofLocals, "supple pose, local matrices, transitions");
    made.roots_ = get(pose_roots_comp, ofClips, "supple pose, roots");
    made.modifiers_ = get(pose_modify_comp, ofLists, "supple pose, modifiers");
    made.palette_ = get(pose_palette_comp, ofPalette,
                        made.rotations_ ? "supple pose, palette with rotations" : "supple pose, palette");
    if (needs.mixes) {
        made.mix_ =
            get(pose_mix_comp, ofMix,
                made.rotations_ ? "supple pose, between palettes with rotations" : "supple pose, between palettes");
    }
    if (needs.drivers) {
        made.drivers_ = get(pose_drivers_comp, ofLists, "supple pose, drivers");
    }
    if (needs.springs) {
        made.springs_ = get(pose_springs_comp, ofLists, "supple pose, springs");
    }
    const Status status = batch.make();
    return status ? Result<PosePipelines>(made) : status.error();
}

void PosePipelines::recordLocals(gpu::Dispatches& dispatches, const gpu::BoundSet& set, Locals what,
                                 const PosePush& push) const {
    const uint64_t items = uint64_t{push.nodeCount} + 1 + (push.morphCount + 3) / 4;
    const uint64_t local = device_->mapping.localSize;
    dispatches.dispatch(locals_[static_cast<size_t>(what)], set, push,
                        (items * push.instanceCount + local - 1) / local);
}

void PosePipelines::recordRoots(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const PosePush& push) const {
    const uint64_t local = device_->mapping.localSize;
    dispatches.dispatch(roots_, set, push, (push.instanceCount + local - 1) / local);
}

void PosePipelines::recordModifiers(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const PosePush& push) const {
    const uint64_t local = device_->mapping.localSize;
    dispatches.dispatch(modifiers_, set, push, (push.instanceCount + local - 1) / local);
}

void PosePipelines::recordDrivers(gpu::Dispatches& dispatches, const gpu::BoundSet& set, uint32_t quads,
                                  const PosePush& push) const {
    const uint64_t local = device_->mapping.localSize;
    dispatches.dispatch(drivers_, set, push, (uint64_t{quads} * push.instanceCount + local - 1) / local);
}

void PosePipelines::recordSprings(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const PosePush& push) const {
    const uint64_t local = device_->mapping.wide ? 1 : device_->mapping.localSize;
    dispatches.dispatch(springs_, set, push, (push.instanceCount + local - 1) / local);
}

void PosePipelines::recordPalette(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const PosePush& push) const {
    const uint64_t local = device_->mapping.wide ? 1 : device_->mapping.localSize;
    dispatches.dispatch(palette_, set, push, (push.instanceCount + local - 1) / local);
}

void PosePipelines::recordMix(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const PosePush& push) const {
    const uint64_t place = rotations_ ? 1 : 0; // the transform
    const uint64_t items = push.jointCount + place + (push.morphCount + 3) / 4;
    const uint64_t local = device_->mapping.localSize;
    dispatches.dispatch(mix_, set, push, (items * push.instanceCount + local - 1) / local);
}

} // namespace supple::skinning
