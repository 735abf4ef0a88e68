#include "runtime/gathered_cage.h"

namespace supple::runtime {

uint32_t GatheredCage::stride() const {
    return InstanceSet::cageStrideOf(piece_->prepared->of.cage.vertexCount());
}

void GatheredCage::plan(gpu::BufferPlan& device, uint32_t capacity) {
    cages_ = device.add({"supple deformed piece", capacity * stride() * gpu::kVec4Bytes,
                         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                         gpu::MemoryPurpose::cages});
}

Status GatheredCage::createSets(const gpu::Device& device, const InstanceSet& instances,
                                const InstanceListing& listing) {
    wholeStride_ = instances.cageStride();
    return sets_.create({&device,
                         &deform_->layout(),
                         &listing.windows(),
                         piece_->vertices.buffer(0),
                         piece_->vertices.size(0),
                         {instances.cages().buffer(), wholeStride_},
                         {cages_.buffer(), stride()},
                         listing.buffer().buffer(),
                         listing.passBytes()});
}

PassCost GatheredCage::record(VkCommandBuffer commandBuffer, const InstanceWindows& windows) const {
    const uint32_t vertices = piece_->prepared->of.cage.vertexCount();
    windows.forEach([&](uint32_t w) {
        shared::DeformPush push{};
        push.vertexCount = vertices;
        push.firstInstance = windows.firstEntry(w);
        push.instanceCount = windows.listed[w].count;
        push.poseStride = wholeStride_;
        push.cageStride = stride();
        deform_->recordGather(commandBuffer, sets_[w], push);
    });
    const uint64_t points = uint64_t{vertices} * windows.visible;
    return {points, points * gpu::kVec4Bytes};
}

void GatheredCage::recordWarmUp(VkCommandBuffer commandBuffer) const {
    deform_->recordGather(commandBuffer, sets_[0], {}); // of no instances
}

} // namespace supple::runtime
