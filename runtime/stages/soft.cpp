#include "runtime/stages/soft.h"

#include "gpu/bound_sets.h"
#include "gpu/tasks.h"
#include "runtime/instance_state.h"
#include "shaders/shared/deform.h"
#include "skinning/soft_kernels.h"

namespace supple::runtime {

namespace {

using namespace supple::shared;

using skinning::SoftKind;

struct SoftStageKernels final : CageKernels {
    skinning::SoftKernels kernels;
};

class SoftStage final : public CageStage {
public:
    /// `soft`: of the asset.
    SoftStage(const CageStageDesc& desc, const SoftOfAsset& soft, const skinning::SoftKernels& own)
        : device_(desc.device), asset_(desc.asset), soft_(&soft), instances_(desc.instances), kernels_(&own) {
        constexpr uint32_t kPadding = 16; // elements: descriptor offsets need at most 256-byte alignment
        stateStride_ = (soft.stateElements + kPadding - 1) / kPadding * kPadding;
    }

    [[nodiscard]] Status createState() {
        addMember(state_);
        return state_.create(*device_, instances_->capacity(), VkDeviceSize{stateStride_} * gpu::kVec4Bytes,
                             "supple soft state");
    }

    [[nodiscard]] BoundBytes boundBytes() const override { return {state_.bytes(), 0}; }

    [[nodiscard]] Status createSets(const CageBuffers& buffers) override {
        cageStride_ = buffers.stride;
        const InstanceWindows& windows = buffers.listing->windows();
        Status status = sets_.create(*device_, kernels_->layout(), windows.count(), "supple soft");
        for (uint32_t w = 0; w < windows.count() && status; ++w) {
            status = writeSet(w, buffers);
        }
        return status;
    }

    void takeOver(CageStage& other, uint32_t count, const AssetMatch& match) override {
        if (match.same) {
            state_.takeOver(static_cast<SoftStage&>(other).state_, count);
        }
    }

    [[nodiscard]] gpu::MemoryUse memoryUse() const override { return state_.memoryUse(); }

    VkDeviceSize recordUpload(const CageFrame& frame) override {
        // The pose pass says who begins anew: with the first step.
        return state_.recordUpload(frame.dispatches.commandBuffer(), frame.number, {});
    }

    PassCost record(const CageFrame& frame) override {
        const uint64_t vertices = recordRound(frame, 0);
        return {vertices, vertices * gpu::kVec4Bytes};
    }
    void recordEarly(const CageFrame& frame, uint32_t round) override { (void)recordRound(frame, round); }

    void recordWarmUp(VkCommandBuffer commandBuffer) const override {
        gpu::OwnDispatches dispatches(*device_, commandBuffer);
        dispatches->computeBarrier();
        SoftPush push{}; // of no instances
        push.firstInfluences = asset_->skin(instances_->skinning()).firstInfluences;
        kernels_->record(*dispatches, sets_[0], instances_->skinning(), push);
    }

private:
    /// What is soft, over the instances that have steps.
    uint64_t recordRound(const CageFrame& frame, uint32_t round) {
        uint64_t items = 0;
        frame.windows.forEach([&](uint32_t w) {
            const SoftPush push = pushOf(w, round);
            if (push.instanceCount > 0 || frame.dispatches.takesEmpty()) {
                kernels_->record(frame.dispatches, sets_[w], instances_->skinning(), push);
                items += uint64_t{push.count} * push.instanceCount;
            }
        });
        return items;
    }

    [[nodiscard]] Status writeSet(uint32_t w, const CageBuffers& buffers) {
        const InstanceWindows& windows = buffers.listing->windows();
        const StepPoses steps = instances_->poses().stepPoses();
        const gpu::StaticBuffers& table = asset_->skin(instances_->skinning()).buffers;
        const gpu::StaticBuffers& soft = soft_->table;
        Status status = success();
        const auto view = [&](const VkDescriptorBufferInfo& info, VkFormat format, const char* name) {
            return views_.make(*device_, info.buffer, format, info.offset, info.range, name, status);
        };
        const auto range = [&](VkBuffer buffer, VkDeviceSize bytes) {
            return VkDescriptorBufferInfo{buffer, windows.firstSlot(w) * bytes, windows.slots(w) * bytes};
        };
        const VkDescriptorBufferInfo tableRange{table.buffer(0), 0, table.size(0)};
        const VkDescriptorBufferInfo softRange{soft.buffer(0), 0, soft.size(0)};
        const VkDescriptorBufferInfo list{steps.list, 0, steps.listBytes};
        const VkDescriptorBufferInfo poses = range(steps.poses, steps.poseBytes);
        const VkDescriptorBufferInfo scratch = range(steps.scratch, steps.scratchBytes);
        const gpu::BoundResource resources[] = {
            {kDeformTableBinding, tableRange, VK_NULL_HANDLE},
            {kDeformTableTexelBinding, {}, view(tableRange, gpu::kUint4, "supple deform table")},
            {kPoseBinding, poses, VK_NULL_HANDLE},
            {kPoseTexelBinding, {}, view(poses, gpu::kFloat4, "supple steps")},
            {kDeformedCageBinding, range(buffers.to, VkDeviceSize{cageStride_} * gpu::kVec4Bytes), VK_NULL_HANDLE},
            {kSoftTableBinding, softRange, VK_NULL_HANDLE},
            {kSoftTableTexelBinding, {}, view(softRange, gpu::kUint4, "supple soft table")},
            {kSoftStateBinding, range(state_.buffer(), state_.bytes()), VK_NULL_HANDLE},
            {kSoftPlaceBinding, scratch, VK_NULL_HANDLE},
            {kSoftPlaceTexelBinding, {}, view(scratch, gpu::kFloat4, "supple node matrices")},
            {kInstanceBinding, list, VK_NULL_HANDLE},
            {kInstanceTexelBinding, {}, view(list, VK_FORMAT_R32_UINT, "supple list of poses")},
        };
        if (status) {
            sets_.write(*device_, kernels_->layout(), w, resources);
        }
        return status;
    }

    [[nodiscard]] SoftPush pushOf(uint32_t window, uint32_t round) const {
        const StepPoses steps = instances_->poses().stepPoses();
        const PoseList::Round& listed = *instances_->poses().listedSteps(window, round);
        const SkinTables& skin = asset_->skin(instances_->skinning());
        SoftPush push{};
        push.count = soft_->count;
        push.firstInstance = listed.poses.first;
        push.instanceCount = listed.stepping.count;
        push.stepping = listed.stepping.first;
        push.shown = listed.shown;
        push.scratchStride = steps.scratchStride;
        push.place = steps.place;
        push.way = steps.way;
        push.stepStride = steps.poseStride;
        push.stateStride = stateStride_;
        push.cageStride = cageStride_;
        push.morphWeights = instances_->poseLayout().morphWeights;
        push.firstInfluences = skin.firstInfluences;
        push.firstCenter = skin.firstCenter;
        return push;
    }

    const gpu::Device* device_;
    const Asset* asset_;
    const SoftOfAsset* soft_;
    const InstanceSet* instances_;
    const skinning::SoftKernels* kernels_;
    uint32_t stateStride_ = 0, cageStride_ = 0; ///< elements of an instance
    InstanceState state_;
    gpu::TexelViews views_;
    gpu::BoundSets sets_; ///< by window
};

Result<std::unique_ptr<CageKernels>> makeSoftKernels(const gpu::Device& device, gpu::Pipelines& pipelines,
                                                     SoftKind kind) {
    Result<skinning::SoftKernels> made = skinning::SoftKernels::create(device, pipelines, kind);
    if (!made) {
        return made.error();
    }
    auto kernels = std::make_unique<SoftStageKernels>();
    kernels->kernels = std::move(*made);
    return std::unique_ptr<CageKernels>(std::move(kernels));
}

Result<std::unique_ptr<CageStage>> makeSoftStage(const CageStageDesc& desc, const SoftOfAsset& soft,
                                                 CageKernels& kernels) {
    skinning::SoftKernels& own = static_cast<SoftStageKernels&>(kernels).kernels;
    const Status prepared = own.prepare(desc.instances->skinning(), desc.asset->hasMorphs());
    if (!prepared) {
        return prepared.error();
    }
    auto stage = std::make_unique<SoftStage>(desc, soft, own);
    const Status created = stage->createState();
    if (!created) {
        return created.error();
    }
    return std::unique_ptr<CageStage>(std::move(stage));
}

Status makeSoftPipelines(bool wanted, const PlannedStages& planned, const CageKernels& kernels) {
    if (!wanted) {
        return success();
    }
    const auto made = static_cast<const SoftStageKernels&>(kernels).kernels.make(planned.skinning, planned.morphs);
    return made ? success() : made.error();
}

bool wantsSoft(const CageStageDesc& desc, const SoftOfAsset& soft) {
    return desc.deforms && desc.instances->room().soft && soft.count > 0;
}

} // namespace

Result<std::unique_ptr<CageKernels>> makeJiggleKernels(const gpu::Device& device, gpu::Pipelines& pipelines) {
    return makeSoftKernels(device, pipelines, SoftKind::jiggle);
}
bool wantsJiggle(const CageStageDesc& desc) {
    return wantsSoft(desc, desc.asset->jiggles);
}
Result<std::unique_ptr<CageStage>> makeJiggle(const CageStageDesc& desc, CageKernels& kernels) {
    return makeSoftStage(desc, desc.asset->jiggles, kernels);
}
Status makeJigglePipelines(const PlannedStages& planned, const CageKernels& kernels) {
    return makeSoftPipelines(planned.jiggles, planned, kernels);
}

Result<std::unique_ptr<CageKernels>> makeClothKernels(const gpu::Device& device, gpu::Pipelines& pipelines) {
    return makeSoftKernels(device, pipelines, SoftKind::cloth);
}
bool wantsCloth(const CageStageDesc& desc) {
    return wantsSoft(desc, desc.asset->cloths);
}
Result<std::unique_ptr<CageStage>> makeCloth(const CageStageDesc& desc, CageKernels& kernels) {
    return makeSoftStage(desc, desc.asset->cloths, kernels);
}
Status makeClothPipelines(const PlannedStages& planned, const CageKernels& kernels) {
    return makeSoftPipelines(planned.cloths, planned, kernels);
}

} // namespace supple::runtime
