#include "runtime/stages/deform.h"

#include "gpu/tasks.h"
#include "runtime/stages/deform_sets.h"

namespace supple::runtime {

namespace {

class Deform final : public CageStage {
public:
    Deform(const CageStageDesc& desc, const skinning::DeformKernels& own)
        : device_(desc.device), asset_(desc.asset), instances_(desc.instances), kernels_(&own) {}

    [[nodiscard]] Status createSets(const CageBuffers& buffers) override {
        const skinning::PoseLayout& layout = instances_->poseLayout();
        const gpu::StaticBuffers& table = asset_->skin(instances_->skinning()).buffers;
        stride_ = buffers.stride;
        return sets_.create({device_,
                             &kernels_->layout(),
                             &buffers.listing->windows(),
                             table.buffer(0),
                             table.size(0),
                             {instances_->palettes().buffer(), layout.stride},
                             {buffers.to, stride_},
                             buffers.listing->buffer().buffer(),
                             buffers.listing->passBytes()});
    }

    void recordWarmUp(VkCommandBuffer commandBuffer) const override {
        gpu::OwnDispatches dispatches(*device_, commandBuffer);
        dispatches->computeBarrier();
        shared::DeformPush push{}; // of no instances
        const SkinTables& skin = asset_->skin(instances_->skinning());
        push.firstInfluences = skin.firstInfluences;
        push.firstCenter = skin.firstCenter;
        kernels_->record(*dispatches, sets_[0], instances_->skinning(), push);
    }

    PassCost record(const CageFrame& frame) override {
        const skinning::PoseLayout& layout = instances_->poseLayout();
        const SkinTables& skin = asset_->skin(layout.mode);
        const uint32_t vertices = asset_->character.cage.vertexCount();
        frame.windows.forEach([&](uint32_t w) {
            kernels_->record(frame.dispatches, sets_[w], layout.mode,
                             {vertices, frame.windows.firstEntry(w), frame.windows.listed[w].count, layout.stride,
                              stride_, layout.morphWeights, skin.firstInfluences, skin.firstCenter});
        });
        const uint64_t points = uint64_t{vertices} * frame.windows.visible;
        return {points, points * gpu::kVec4Bytes};
    }

private:
    const gpu::Device* device_;
    const Asset* asset_;
    const InstanceSet* instances_;
    const skinning::DeformKernels* kernels_;
    uint32_t stride_ = 0;
    DeformSets sets_;
};

} // namespace

Result<std::unique_ptr<CageKernels>> makeDeformKernels(const gpu::Device& device, gpu::Pipelines& pipelines) {
    Result<skinning::DeformKernels> made = skinning::DeformKernels::create(device, pipelines);
    if (!made) {
        return made.error();
    }
    auto kernels = std::make_unique<DeformStageKernels>();
    kernels->kernels = std::move(*made);
    return std::unique_ptr<CageKernels>(std::move(kernels));
}

bool wantsDeform(const CageStageDesc& desc) {
    return desc.deforms;
}

Result<std::unique_ptr<CageStage>> makeDeform(const CageStageDesc& desc, CageKernels& kernels) {
    skinning::DeformKernels& own = static_cast<DeformStageKernels&>(kernels).kernels;
    const Status prepared = own.prepare(desc.instances->skinning(), desc.asset->hasMorphs());
    if (!prepared) {
        return prepared.error();
    }
    return std::unique_ptr<CageStage>(std::make_unique<Deform>(desc, own));
}

Status makeDeformPipelines(const PlannedStages& planned, const CageKernels& kernels) {
    if (!planned.deforms) {
        return success();
    }
    const auto made = static_cast<const DeformStageKernels&>(kernels).kernels.make(planned.skinning, planned.morphs);
    return made ? success() : made.error();
}

} // namespace supple::runtime
