// One frame, as the data flows: upload, pose, deform, vertex, edge, patch, evaluate, motion.
#include "runtime/context.h"

namespace supple::runtime {

namespace {

using surface::Stage;

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kTransfer = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
constexpr VkAccessFlags2 kRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
constexpr VkAccessFlags2 kWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
constexpr gpu::SyncScope kFirst{kCompute | kTransfer, kRead | kWrite | VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr gpu::SyncScope kLast{kCompute | kTransfer, kWrite | VK_ACCESS_2_TRANSFER_WRITE_BIT};

} // namespace

SuppleSyncScope Context::firstScope() {
    return {kFirst.stages, kFirst.access};
}

SuppleSyncScope Context::lastScope() {
    return {kLast.stages, kLast.access};
}

Status Context::checkRecord(const SuppleRecordDesc& desc) const {
    if (!frameOpen_) {
        return Error{ErrorCode::order, "suppleRecord: no frame has begun, or it is cancelled"};
    }
    for (uint32_t g = 0; g < desc.groupCount; ++g) {
        // The words are put together only where they are needed: recording allocates nothing.
        const auto refuse = [g](ErrorCode code, const std::string& reason) {
            return Error{code, "suppleRecord: group " + std::to_string(g) + ": " + reason};
        };
        const std::shared_ptr<Group> group = groups.find(desc.groups[g].id);
        if (group == nullptr) {
            return refuse(ErrorCode::staleHandle, "stale or foreign handle");
        }
        if (group->passesFrame() == frame_) {
            return refuse(ErrorCode::order, "recorded twice in frame " + std::to_string(frame_));
        }
        for (uint32_t h = 0; h < g; ++h) {
            if (desc.groups[h].id == desc.groups[g].id) {
                return refuse(ErrorCode::argument, "listed twice");
            }
        }
    }
    return success();
}

VkDeviceSize Context::recordStatics(VkCommandBuffer commandBuffer, Group& group) {
    return pairs_.recordUpload(commandBuffer, frame_) + group.recordStatics(commandBuffer, frame_);
}

Status Context::recordUploads(VkCommandBuffer commandBuffer) {
    if (!frameOpen_) {
        return Error{ErrorCode::order, "suppleRecordUploads: no frame has begun, or it is cancelled"};
    }
    const std::scoped_lock lock(uploads_);
    bool recorded = false;
    groups.forEach([&](Group& group) {
        if (group.staticsPending()) {
            recordStatics(commandBuffer, group);
            recorded = true;
        }
    });
    if (recorded) {
        gpu::memoryBarrier(*device_, commandBuffer, {kTransfer, VK_ACCESS_2_TRANSFER_WRITE_BIT}, kFirst);
    }
    return success();
}

Status Context::record(VkCommandBuffer commandBuffer, const SuppleRecordDesc& desc) {
    Status valid = checkRecord(desc);
    if (!valid) {
        return valid;
    }
    const gpu::Device& device = *device_;
    const auto groupAt = [&](uint32_t g) -> Group& { return *groups.find(desc.groups[g].id); };
    Timings::Recording timing;
    // One pass over all groups: labelled, timed per group.
    const auto pass = [&](Pass kind, auto&& recordGroup) {
        device.beginLabel(commandBuffer, passName(kind));
        for (uint32_t g = 0; g < desc.groupCount; ++g) {
            Group& group = groupAt(g);
            timing.beginPass();
            const Group::PassCost cost = recordGroup(group);
            if (cost.bytes > 0) {
                timing.endPass(kind, desc.groups[g], cost.points, cost.bytes);
            }
        }
        device.endLabel(commandBuffer);
    };
    const auto any = [&](auto&& predicate) {
        for (uint32_t g = 0; g < desc.groupCount; ++g) {
            if (predicate(groupAt(g))) {
                return true;
            }
        }
        return false;
    };
    const auto computeBarrier = [&] { gpu::computeBarrier(device, commandBuffer); };

    device.beginLabel(commandBuffer, "supple");
    if ((desc.flags & SUPPLE_RECORD_NO_ENTRY_BARRIER) == 0) {
        // Earlier frames' passes and the host's uses end before this frame overwrites anything.
        gpu::memoryBarrier(device, commandBuffer,
                           {desc.before.stages | kLast.stages, desc.before.access | kLast.access}, kFirst);
    }
    if ((desc.flags & SUPPLE_RECORD_TIMINGS) != 0) {
        timing = timings.open(commandBuffer, desc.groupCount);
    }

    pass(Pass::upload, [&](Group& group) {
        VkDeviceSize statics = 0;
        {
            const std::scoped_lock lock(uploads_);
            if (group.staticsPending()) {
                statics = recordStatics(commandBuffer, group);
            }
        }
        Group::PassCost cost = group.recordUpload(commandBuffer, frame_);
        cost.bytes += statics;
        return cost;
    });
    gpu::memoryBarrier(device, commandBuffer, {kTransfer, VK_ACCESS_2_TRANSFER_WRITE_BIT}, {kCompute, kRead | kWrite});

    if (any([](Group& group) { return group.attributesPending(); })) {
        pass(Pass::attributes, [&](Group& group) { return group.recordAttributes(commandBuffer); });
    }
    if (any([](Group& group) { return group.plays(); })) {
        pass(Pass::pose, [&](Group& group) { return group.recordPose(commandBuffer); });
        computeBarrier();
    }
    pass(Pass::deform, [&](Group& group) { return group.recordDeform(commandBuffer); });
    computeBarrier();
    const auto construct = [&](Stage stage, Pass kind) {
        if (any([&](Group& group) { return group.tables().has(stage); })) {
            pass(kind, [&](Group& group) { return group.recordStage(commandBuffer, stage); });
            computeBarrier();
        }
    };
    construct(Stage::vertex, Pass::vertex);
    construct(Stage::edge, Pass::edge);
    if (any([](Group& group) { return group.writesPatches(); })) {
        pass(Pass::patch, [&](Group& group) { return group.recordPatch(commandBuffer); });
    }
    pass(Pass::evaluate, [&](Group& group) { return group.recordEvaluate(commandBuffer); });
    if (any([](Group& group) { return group.writesMotion(); })) {
        if (any([](Group& group) { return group.writesMotion() && group.usesScratch(); })) {
            computeBarrier();
        }
        pass(Pass::motion, [&](Group& group) { return group.recordMotion(commandBuffer); });
    }

    if (asyncCompute_) {
        Group::Transfers transfers;
        for (uint32_t g = 0; g < desc.groupCount; ++g) {
            const uint32_t count = groupAt(g).transfers(transfers);
            for (uint32_t i = 0; i < count; ++i) {
                transfers[i].srcStageMask = kLast.stages;
                transfers[i].srcAccessMask = kLast.access;
                transfers[i].srcQueueFamilyIndex = queueFamily_;
                transfers[i].dstQueueFamilyIndex = drawQueueFamily_;
            }
            VkDependencyInfo release{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
            release.bufferMemoryBarrierCount = count;
            release.pBufferMemoryBarriers = transfers.data();
            device.vk.CmdPipelineBarrier2(commandBuffer, &release);
        }
    }
    if (desc.after.stages != 0) {
        gpu::memoryBarrier(device, commandBuffer, kLast, {desc.after.stages, desc.after.access});
    }
    device.endLabel(commandBuffer);
    return success();
}

Result<uint32_t> Context::acquireBarriers(std::span<const SuppleGroup> wanted, SuppleSyncScope use,
                                          std::span<VkBufferMemoryBarrier2> out) const {
    if (!asyncCompute_) {
        return Error{ErrorCode::argument, "suppleGetAcquireBarriers: the context has no SUPPLE_CONTEXT_ASYNC_COMPUTE"};
    }
    // All checks before the first barrier is written: a call that fails has done nothing.
    for (size_t g = 0; g < wanted.size(); ++g) {
        const std::shared_ptr<Group> group = groups.find(wanted[g].id);
        const auto refuse = [g](ErrorCode code, const char* reason) {
            return Error{code, "suppleGetAcquireBarriers: group " + std::to_string(g) + ": " + reason};
        };
        if (group == nullptr) {
            return refuse(ErrorCode::staleHandle, "stale or foreign handle");
        }
        if (group->passesFrame() != frame_ || !frameOpen_) {
            return refuse(ErrorCode::order, "not recorded in this frame");
        }
    }
    uint32_t total = 0;
    for (const SuppleGroup& own : wanted) {
        Group::Transfers transfers;
        const uint32_t count = groups.find(own.id)->transfers(transfers);
        for (uint32_t i = 0; i < count; ++i, ++total) {
            if (total < out.size()) {
                out[total] = transfers[i];
                out[total].dstStageMask = use.stages;
                out[total].dstAccessMask = use.access;
                out[total].srcQueueFamilyIndex = queueFamily_;
                out[total].dstQueueFamilyIndex = drawQueueFamily_;
            }
        }
    }
    return total;
}

} // namespace supple::runtime
