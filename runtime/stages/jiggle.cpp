#include "runtime/stages/jiggle.h"

#include "gpu/bound_sets.h"
#include "gpu/tasks.h"
#include "runtime/instance_state.h"
#include "runtime/playback.h"
#include "shaders/shared/deform.h"
#include "skinning/jiggle_kernels.h"

namespace supple::runtime {

namespace {

using namespace supple::shared;

struct JiggleStageKernels final : CageKernels {
    skinning::JiggleKernels kernels;
};

class JiggleStage final : public CageStage {
public:
    JiggleStage(const CageStageDesc& desc, const skinning::JiggleKernels& own)
        : device_(desc.device), asset_(desc.asset), instances_(desc.instances), kernels_(&own) {
        constexpr uint32_t kPadding = 16; // elements: descriptor offsets need at most 256-byte alignment
        const uint32_t elements = kJiggleVertices + kJiggleElements * asset_->jiggleCount;
        stateStride_ = (elements + kPadding - 1) / kPadding * kPadding;
    }

    [[nodiscard]] Status createState() {
        addMember(state_);
        return state_.create(*device_, instances_->capacity(), VkDeviceSize{stateStride_} * gpu::kVec4Bytes,
                             "supple jiggles");
    }

    [[nodiscard]] BoundBytes boundBytes() const override { return {state_.bytes(), 0}; }

    [[nodiscard]] Status createSets(const CageBuffers& buffers) override {
        cageStride_ = buffers.stride;
        const InstanceWindows& windows = buffers.listing->windows();
        Status status = sets_.create(*device_, kernels_->layout(), windows.count(), "supple jiggle");
        for (uint32_t w = 0; w < windows.count() && status; ++w) {
            status = writeSet(w, buffers);
        }
        return status;
    }

    void takeOver(CageStage& other, uint32_t count, const AssetMatch& match) override {
        if (match.same) {
            state_.takeOver(static_cast<JiggleStage&>(other).state_, count);
        }
    }

    [[nodiscard]] gpu::MemoryUse memoryUse() const override { return state_.memoryUse(); }

    VkDeviceSize recordUpload(const CageFrame& frame) override {
        // The pose pass says who begins anew: with the first step.
        return state_.recordUpload(frame.dispatches.commandBuffer(), frame.number, {});
    }

    PassCost record(const CageFrame& frame) override {
        uint64_t vertices = 0;
        frame.windows.forEach([&](uint32_t w) {
            const JigglePush push = pushOf(w);
            if (push.instanceCount > 0) {
                kernels_->record(frame.dispatches, sets_[w], instances_->skinning(), push);
                vertices += uint64_t{push.vertexCount} * push.instanceCount;
            }
        });
        return {vertices, vertices * gpu::kVec4Bytes};
    }

    void recordWarmUp(VkCommandBuffer commandBuffer) const override {
        gpu::OwnDispatches dispatches(*device_, commandBuffer);
        dispatches->computeBarrier();
        JigglePush push{}; // of no instances
        push.firstInfluences = asset_->skin(instances_->skinning()).firstInfluences;
        kernels_->record(*dispatches, sets_[0], instances_->skinning(), push);
    }

private:
    [[nodiscard]] const Playback& playback() const { return instances_->playback(); }

    [[nodiscard]] Status writeSet(uint32_t w, const CageBuffers& buffers) {
        const InstanceWindows& windows = buffers.listing->windows();
        const Playback::StepPoses steps = playback().stepPoses();
        const gpu::StaticBuffers& table = asset_->skin(instances_->skinning()).buffers;
        const gpu::StaticBuffers& jiggles = asset_->jiggles;
        Status status = success();
        const auto view = [&](const VkDescriptorBufferInfo& info, VkFormat format, const char* name) {
            return views_.make(*device_, info.buffer, format, info.offset, info.range, name, status);
        };
        const auto range = [&](VkBuffer buffer, VkDeviceSize bytes) {
            return VkDescriptorBufferInfo{buffer, windows.firstSlot(w) * bytes, windows.slots(w) * bytes};
        };
        const VkDescriptorBufferInfo tableRange{table.buffer(0), 0, table.size(0)};
        const VkDescriptorBufferInfo jiggleRange{jiggles.buffer(0), 0, jiggles.size(0)};
        const VkDescriptorBufferInfo list{steps.list, 0, steps.listBytes};
        const VkDescriptorBufferInfo poses = range(steps.poses, steps.poseBytes);
        const VkDescriptorBufferInfo scratch = range(steps.scratch, steps.scratchBytes);
        const gpu::BoundResource resources[] = {
            {kDeformTableBinding, tableRange, VK_NULL_HANDLE},
            {kDeformTableTexelBinding, {}, view(tableRange, gpu::kUint4, "supple deform table")},
            {kPoseBinding, poses, VK_NULL_HANDLE},
            {kPoseTexelBinding, {}, view(poses, gpu::kFloat4, "supple steps")},
            {kDeformedCageBinding, range(buffers.to, VkDeviceSize{cageStride_} * gpu::kVec4Bytes), VK_NULL_HANDLE},
            {kJiggleTableBinding, jiggleRange, VK_NULL_HANDLE},
            {kJiggleTableTexelBinding, {}, view(jiggleRange, gpu::kUint4, "supple jiggle table")},
            {kJiggleStateBinding, range(state_.buffer(), state_.bytes()), VK_NULL_HANDLE},
            {kJigglePlaceBinding, scratch, VK_NULL_HANDLE},
            {kJigglePlaceTexelBinding, {}, view(scratch, gpu::kFloat4, "supple node matrices")},
            {kInstanceBinding, list, VK_NULL_HANDLE},
            {kInstanceTexelBinding, {}, view(list, VK_FORMAT_R32_UINT, "supple list of poses")},
        };
        if (status) {
            sets_.write(*device_, kernels_->layout(), w, resources);
        }
        return status;
    }

    [[nodiscard]] JigglePush pushOf(uint32_t window) const {
        const Playback::StepPoses steps = playback().stepPoses();
        const PoseList::Window& listed = playback().listedPoses(window);
        JigglePush push{};
        push.vertexCount = asset_->jiggleCount;
        push.firstInstance = listed.poses.first;
        push.instanceCount = listed.swinging.count;
        push.swinging = listed.swinging.first;
        push.shown = listed.shown;
        push.scratchStride = steps.scratchStride;
        push.place = steps.place;
        push.way = steps.way;
        push.stepStride = steps.poseStride;
        push.stateStride = stateStride_;
        push.cageStride = cageStride_;
        push.morphWeights = instances_->poseLayout().morphWeights;
        push.firstInfluences = asset_->skin(instances_->skinning()).firstInfluences;
        push.firstCenter = asset_->skin(instances_->skinning()).firstCenter;
        return push;
    }

    const gpu::Device* device_;
    const Asset* asset_;
    const InstanceSet* instances_;
    const skinning::JiggleKernels* kernels_;
    uint32_t stateStride_ = 0, cageStride_ = 0; ///< elements of an instance
    InstanceState state_;
    gpu::TexelViews views_;
    gpu::BoundSets sets_; ///< by window
};

} // namespace

Result<std::unique_ptr<CageKernels>> makeJiggleKernels(const gpu::Device& device, gpu::Pipelines& pipelines) {
    Result<skinning::JiggleKernels> made = skinning::JiggleKernels::create(device, pipelines);
    if (!made) {
        return made.error();
    }
    auto kernels = std::make_unique<JiggleStageKernels>();
    kernels->kernels = std::move(*made);
    return std::unique_ptr<CageKernels>(std::move(kernels));
}

bool wantsJiggle(const CageStageDesc& desc) {
    return desc.deforms && desc.instances->room().jiggles;
}

Result<std::unique_ptr<CageStage>> makeJiggle(const CageStageDesc& desc, CageKernels& kernels) {
    skinning::JiggleKernels& own = static_cast<JiggleStageKernels&>(kernels).kernels;
    const Status prepared = own.prepare(desc.instances->skinning(), desc.asset->hasMorphs());
    if (!prepared) {
        return prepared.error();
    }
    auto stage = std::make_unique<JiggleStage>(desc, own);
    const Status created = stage->createState();
    if (!created) {
        return created.error();
    }
    return std::unique_ptr<CageStage>(std::move(stage));
}

Status makeJigglePipelines(const PlannedStages& planned, const CageKernels& kernels) {
    if (!planned.jiggles) {
        return success();
    }
    const auto made = static_cast<const JiggleStageKernels&>(kernels).kernels.make(planned.skinning, planned.morphs);
    return made ? success() : made.error();
}

} // namespace supple::runtime
