#include "runtime/stages/gather.h"

#include "gpu/tasks.h"
#include "runtime/stages/deform_sets.h"

namespace supple::runtime {

namespace {

class Gather final : public CageStage {
public:
    Gather(const CageStageDesc& desc, const skinning::DeformKernels& own)
        : device_(desc.device), capacity_(desc.instances->capacity()), kernels_(&own), pieces_(desc.surfaces->size()) {
        for (size_t surface = 0; surface < pieces_.size(); ++surface) {
            pieces_[surface].of = (*desc.surfaces)[surface].piece();
        }
    }

    void plan(gpu::BufferPlan& device, gpu::BufferPlan&) override {
        for (Piece& piece : pieces_) {
            if (piece.of != nullptr) {
                piece.cages =
                    device.add({"supple deformed piece", VkDeviceSize{capacity_} * piece.stride() * gpu::kVec4Bytes,
                                VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                                gpu::MemoryPurpose::cages});
            }
        }
    }

    [[nodiscard]] Status createSets(const CageBuffers& buffers) override {
        wholeStride_ = buffers.stride;
        Status status = success();
        for (Piece& piece : pieces_) {
            if (piece.of == nullptr || !status) {
                continue;
            }
            gpu::StaticBuffers& vertices = piece.of->vertices;
            addMember(vertices);
            status = piece.sets.create({device_,
                                        &kernels_->layout(),
                                        &buffers.listing->windows(),
                                        vertices.buffer(0),
                                        vertices.size(0),
                                        {buffers.from, wholeStride_},
                                        {piece.cages.buffer(), piece.stride()},
                                        buffers.listing->buffer().buffer(),
                                        buffers.listing->passBytes()});
        }
        return status;
    }

    [[nodiscard]] const gpu::PlannedBuffer* cagesOf(uint32_t surface) const override {
        return pieces_[surface].of != nullptr ? &pieces_[surface].cages : nullptr;
    }

    void recordWarmUp(VkCommandBuffer commandBuffer) const override {
        gpu::OwnDispatches dispatches(*device_, commandBuffer);
        for (const Piece& piece : pieces_) {
            if (piece.of != nullptr) {
                dispatches->computeBarrier();
                kernels_->recordGather(*dispatches, piece.sets[0], {}); // of no instances
            }
        }
    }

    PassCost record(const CageFrame& frame) override {
        const Piece& piece = pieces_[frame.surface];
        if (piece.of == nullptr) {
            return {};
        }
        shared::DeformPush push{};
        push.vertexCount = piece.vertexCount();
        push.poseStride = wholeStride_;
        push.cageStride = piece.stride();
        frame.windows.forEach([&](uint32_t w) {
            push.firstInstance = frame.windows.firstEntry(w);
            push.instanceCount = frame.windows.listed[w].count;
            kernels_->recordGather(frame.dispatches, piece.sets[w], push);
        });
        const uint64_t points = uint64_t{push.vertexCount} * frame.windows.visible;
        return {points, points * gpu::kVec4Bytes};
    }

private:
    struct Piece {
        AssetPiece* of = nullptr; ///< null: the surface has all of the cage
        gpu::PlannedBuffer cages;
        DeformSets sets;

        [[nodiscard]] uint32_t vertexCount() const { return of->prepared->of.cage.vertexCount(); }
        [[nodiscard]] uint32_t stride() const { return InstanceSet::cageStrideOf(vertexCount()); }
    };

    const gpu::Device* device_;
    uint32_t capacity_;
    const skinning::DeformKernels* kernels_;
    uint32_t wholeStride_ = 0;
    std::vector<Piece> pieces_; ///< by surface
};

} // namespace

bool wantsGather(const CageStageDesc& desc) {
    return desc.surfaces->any([](const Tessellation& surface) { return surface.piece() != nullptr; });
}

Result<std::unique_ptr<CageStage>> makeGather(const CageStageDesc& desc, CageKernels& kernels) {
    skinning::DeformKernels& own = static_cast<DeformStageKernels&>(kernels).kernels;
    const Status prepared = own.prepareGather();
    if (!prepared) {
        return prepared.error();
    }
    return std::unique_ptr<CageStage>(std::make_unique<Gather>(desc, own));
}

Status makeGatherPipelines(const PlannedStages& planned, const CageKernels& kernels) {
    if (!planned.pieces) {
        return success();
    }
    const Result<gpu::Kernel> made = static_cast<const DeformStageKernels&>(kernels).kernels.makeGather();
    return made ? success() : made.error();
}

} // namespace supple::runtime
