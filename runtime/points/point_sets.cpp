#include "runtime/points/point_sets.h"

namespace supple::runtime {

void PointSets::remove(const PointSet& set, uint64_t lastFrame) {
    for (Entry& entry : sets_) {
        if (entry.set.get() == &set) {
            entry.removed = true;
            entry.lastFrame = lastFrame;
        }
    }
}

bool PointSets::empty() const {
    bool any = false;
    forEach([&](const PointSet&) { any = true; });
    return !any;
}

gpu::MemoryUse PointSets::memoryUse() const {
    gpu::MemoryUse use;
    forEach([&](const PointSet& set) { use += set.memoryUse(); });
    return use;
}

gpu::TaskNeeds PointSets::taskNeeds() const {
    gpu::TaskNeeds needs;
    forEach([&](const PointSet& set) { needs += set.taskNeeds(); });
    return needs;
}

bool PointSets::havePasts() const {
    bool any = false;
    forEach([&](const PointSet& set) { any = any || set.hasPasts(); });
    return any;
}

bool PointSets::beginsAny() const {
    bool any = false;
    forEach([&](const PointSet& set) { any = any || set.begins(); });
    return any;
}

void PointSets::noteAsked(uint64_t frame) {
    for (Entry& entry : sets_) {
        entry.askedFrame = frame;
    }
}

void PointSets::addTransfers(Transfers& transfers, uint64_t frame) const {
    for (const Entry& entry : sets_) { // the releases of those that were removed since are recorded
        if (entry.askedFrame == frame && frame != 0 && (!entry.removed || entry.lastFrame == frame)) {
            entry.set->addTransfers(transfers);
        }
    }
}

PassCost PointSets::record(gpu::Dispatches& dispatches, uint64_t frame, const glm::vec3& pastStep) {
    PassCost cost;
    forEach([&](PointSet& set) { cost += set.record(dispatches, frame, pastStep); });
    return cost;
}

bool PointSets::copyVertices() const {
    bool any = false;
    forEach([&](const PointSet& set) { any = any || set.copiesVertices(); });
    return any;
}

PassCost PointSets::recordCopies(gpu::Dispatches& dispatches) const {
    PassCost cost;
    forEach([&](const PointSet& set) { cost += set.recordCopies(dispatches); });
    return cost;
}

Status PointSets::bindVertices() {
    Status status = success();
    forEach([&](PointSet& set) { status = status ? set.bindVertices() : status; });
    return status;
}

void PointSets::unbindVertices() {
    for (const Entry& entry : sets_) {
        entry.set->unbindVertices();
    }
}

bool PointSets::uploadsPending() const {
    bool pending = false;
    forEach([&](const PointSet& set) { pending = pending || set.staticsPending(); });
    return pending;
}

VkDeviceSize PointSets::recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) {
    VkDeviceSize bytes = 0;
    forEach([&](PointSet& set) { bytes += set.recordStatics(commandBuffer, frame); });
    return bytes;
}

void PointSets::countStatics(gpu::StaticCount& count) const {
    forEach([&](const PointSet& set) { set.countStatics(count); });
}

Status PointSets::stageStatics() {
    Status status = success();
    forEach([&](PointSet& set) { status = status ? set.stageStatics() : status; });
    return status;
}

void PointSets::recordWarmUp(VkCommandBuffer commandBuffer) const {
    forEach([&](const PointSet& set) { set.recordWarmUp(commandBuffer); });
}

void PointSets::beginFrame(uint64_t completedFrame) {
    std::erase_if(sets_, [&](const Entry& entry) { return entry.removed && entry.lastFrame <= completedFrame; });
    forEach([&](PointSet& set) { set.beginFrame(completedFrame); });
}

void PointSets::cancelFrame(uint64_t frame) {
    forEach([&](PointSet& set) { set.cancelFrame(frame); });
}

} // namespace supple::runtime
