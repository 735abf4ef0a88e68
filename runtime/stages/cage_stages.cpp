#include "runtime/stages/cage_stages.h"

#include "runtime/stages/deform.h"
#include "runtime/stages/gather.h"
#include "runtime/stages/soft.h"

namespace supple::runtime {

namespace {

constexpr CageStageRow kRows[] = {kDeformRow, kJiggleRow, kClothRow, kGatherRow};

} // namespace

std::span<const CageStageRow> cageStageRows() {
    return kRows;
}

Result<CageKernels*> CageStageTable::kernels(size_t row, const gpu::Device& device, gpu::Pipelines& pipelines) {
    const std::scoped_lock lock(*mutex_);
    for (size_t other = 0; other < rows_.size() && kernels_[row] == nullptr; ++other) {
        if (rows_[other].makeKernels == rows_[row].makeKernels) {
            kernels_[row] = kernels_[other];
        }
    }
    if (kernels_[row] == nullptr) {
        Result<std::unique_ptr<CageKernels>> made = rows_[row].makeKernels(device, pipelines);
        if (!made) {
            return made.error();
        }
        kernels_[row] = std::move(*made);
    }
    return kernels_[row].get();
}

Status CageStageTable::makePipelines(const PlannedStages& planned, const gpu::Device& device,
                                     gpu::Pipelines& pipelines) {
    for (size_t row = 0; row < rows_.size(); ++row) {
        if (rows_[row].makePipelines == nullptr) {
            continue;
        }
        const Result<CageKernels*> own = kernels(row, device, pipelines);
        if (!own) {
            return own.error();
        }
        if (Status made = rows_[row].makePipelines(planned, **own); !made) {
            return made;
        }
    }
    return success();
}

Status CageStages::create(CageStageTable& table, gpu::Pipelines& pipelines, const CageStageDesc& desc) {
    const std::span<const CageStageRow> rows = table.rows();
    device_ = desc.device;
    stages_.resize(rows.size());
    for (size_t row = 0; row < rows.size(); ++row) {
        if (!rows[row].wants(desc)) {
            continue;
        }
        const Result<CageKernels*> kernels = table.kernels(row, *desc.device, pipelines);
        if (!kernels) {
            return kernels.error();
        }
        Result<std::unique_ptr<CageStage>> stage = rows[row].make(desc, **kernels);
        if (!stage) {
            return stage.error();
        }
        stages_[row] = std::move(*stage);
        keepReach_ = keepReach_ && rows[row].keepsReach;
        tasks_ = std::min(tasks_, rows[row].tasks);
        addMember(*stages_[row]);
    }
    stride_ = desc.instances->cageStride();
    cageBytes_ = VkDeviceSize{desc.instances->capacity()} * stride_ * gpu::kVec4Bytes;
    bool keeps = false;
    forEach([&](const CageStage& stage) { keeps = keeps || stage.keepsInstances(); });
    pasts_.resize(keeps ? desc.instances->capacity() : 0);
    newSlots_.reserve(pasts_.size());
    return success();
}

BoundBytes CageStages::boundBytes() const {
    BoundBytes most;
    forEach([&](const CageStage& stage) { most = most.with(stage.boundBytes()); });
    return most;
}

void CageStages::plan(gpu::BufferPlan& device, gpu::BufferPlan& staging) {
    bool apart = false;
    forEach([&](CageStage& stage) {
        apart = apart || stage.writesApart();
        stage.plan(device, staging);
    });
    between_ = device.add({"supple cage between stages", apart ? cageBytes_ : 0,
                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                           gpu::MemoryPurpose::cages});
}

Status CageStages::createSets(const gpu::PlannedBuffer& cages, const InstanceListing& listing) {
    cages_ = cages;
    windows_ = &listing.windows();
    // Stages that write apart take turns with two buffers, so that the last one leaves `cages`.
    bool atBetween = false;
    forEach([&](const CageStage& stage) { atBetween = atBetween != stage.writesApart(); });
    Status status = success();
    forEach([&](CageStage& stage) {
        const VkBuffer from = atBetween ? between_.buffer() : cages.buffer();
        atBetween = atBetween != stage.writesApart();
        const VkBuffer to = atBetween ? between_.buffer() : cages.buffer();
        status = status ? stage.createSets({from, to, stride_, &listing}) : status;
    });
    return status;
}

void CageStages::takeOver(CageStages& other, uint32_t count, const AssetMatch& match) {
    std::copy_n(other.pasts_.begin(), std::min({size_t{count}, other.pasts_.size(), pasts_.size()}), pasts_.begin());
    time_ = other.time_;
    timed_ = other.timed_;
    for (size_t row = 0; row < stages_.size(); ++row) {
        if (has(row) && other.has(row)) {
            stages_[row]->takeOver(*other.stages_[row], count, match);
        }
    }
}

gpu::MemoryUse CageStages::memoryUse() const {
    gpu::MemoryUse use;
    forEach([&](const CageStage& stage) { use += stage.memoryUse(); });
    return use;
}

const gpu::PlannedBuffer& CageStages::cagesOf(uint32_t surface) const {
    const gpu::PlannedBuffer* last = nullptr;
    forEach([&](const CageStage& stage) {
        const gpu::PlannedBuffer* const own = stage.cagesOf(surface);
        last = own != nullptr ? own : last;
    });
    return last != nullptr ? *last : cages_;
}

void CageStages::findNew(const InstanceSlots& slots) {
    newSlots_.clear();
    for (uint32_t slot = 0; slot < pasts_.size(); ++slot) {
        const uint32_t now = slot < slots.end() && slots.shows(slot) ? slots.birth(slot) : 0;
        if (now != 0 && now != pasts_[slot]) {
            newSlots_.push_back(slot);
        }
        pasts_[slot] = now;
    }
}

CageFrame CageStages::frame(gpu::Dispatches& dispatches, uint32_t surface) const {
    return {dispatches, frame_, seconds_, *windows_, newSlots_, surface};
}

VkDeviceSize CageStages::recordUpload(VkCommandBuffer commandBuffer, uint64_t frame, double time,
                                      const InstanceSlots& slots) {
    frame_ = frame;
    seconds_ = timed_ ? std::max(0.0, time - time_) : 0.0;
    time_ = time;
    timed_ = true;
    findNew(slots);
    gpu::SingleDispatches dispatches(*device_, commandBuffer);
    VkDeviceSize bytes = 0;
    forEach([&](CageStage& stage) { bytes += stage.recordUpload(this->frame(dispatches, SUPPLE_NO_SURFACE)); });
    return bytes;
}

PassCost CageStages::record(gpu::Dispatches& dispatches, size_t row, uint32_t surface) {
    return has(row) ? stages_[row]->record(frame(dispatches, surface)) : PassCost{};
}

void CageStages::recordEarly(gpu::Dispatches& dispatches, uint32_t round) {
    forEach([&](CageStage& stage) { stage.recordEarly(frame(dispatches, SUPPLE_NO_SURFACE), round); });
}

void CageStages::cancelFrame(uint64_t frame) {
    FrameMembers::cancelFrame(frame);
    if (frame_ == frame) {
        std::fill(pasts_.begin(), pasts_.end(), 0);
        timed_ = false;
    }
}

} // namespace supple::runtime
