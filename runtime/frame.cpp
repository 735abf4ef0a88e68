// One frame, as the data flows: upload, pose, deform, bounds, list, vertex, edge, patch, level, solve, place, evaluate,
// motion.
#include "runtime/context.h"

#include <algorithm>

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
        if (group->view() != nullptr && !group->view()->hasCamera()) {
            return refuse(ErrorCode::order, "its view has no camera yet");
        }
        if (group->view() != nullptr && group->view()->lastRecordedFrame() == frame_) {
            return refuse(ErrorCode::order, "other groups of its view are recorded already: one call takes them all");
        }
    }
    return success();
}

VkDeviceSize Context::recordStatics(VkCommandBuffer commandBuffer, Group& group) {
    const VkDeviceSize ofView = group.view() != nullptr ? group.view()->recordStatics(commandBuffer, frame_) : 0;
    return pairs_.recordUpload(commandBuffer, frame_) + ofView + group.recordStatics(commandBuffer, frame_);
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
            if (cost.bytes > 0 || cost.onDevice) {
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
    // Each view once, with the first of its groups.
    const auto firstOfView = [&](uint32_t g) {
        const View* view = groupAt(g).view();
        for (uint32_t h = 0; view != nullptr && h < g; ++h) {
            if (groupAt(h).view() == view) {
                return false;
            }
        }
        return view != nullptr;
    };
    const bool views = any([](Group& group) { return group.view() != nullptr; });

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
        if (group.view() != nullptr && group.view()->lastRecordedFrame() != frame_) {
            cost.bytes += group.view()->recordUpload(commandBuffer, frame_);
        }
        return cost;
    });
    gpu::memoryBarrier(device, commandBuffer, {kTransfer, VK_ACCESS_2_TRANSFER_WRITE_BIT}, {kCompute, kRead | kWrite});

    if (any([](Group& group) { return group.attributesPending(); })) {
        pass(Pass::attributes, [&](Group& group) { return group.recordAttributes(commandBuffer); });
    }
    if (any([](Group& group) { return group.plays(); })) {
        for (const Playback::Part part : Playback::kParts) {
            if (part != Playback::Part::roots || any([](Group& group) { return group.movesRoots(); })) {
                pass(Pass::pose, [&](Group& group) { return group.recordPose(commandBuffer, part); });
                computeBarrier();
            }
        }
    }
    pass(Pass::deform, [&](Group& group) { return group.recordDeform(commandBuffer); });
    computeBarrier();
    if (views) {
        pass(Pass::bounds, [&](Group& group) { return group.recordBounds(commandBuffer); });
        computeBarrier();
        if (any([](Group& group) { return group.occludes(); })) {
            pass(Pass::bounds, [&](Group& group) { return group.recordOcclusion(commandBuffer); });
            computeBarrier();
        }
        // Where even the coarsest surfaces of all might not have room, those that go are found first.
        const auto roomOf = [&](const View* view) {
            uint64_t least = 0;
            for (uint32_t g = 0; g < desc.groupCount; ++g) {
                least += groupAt(g).view() == view ? groupAt(g).leastVertices() : 0;
            }
            return least <= view->room() ? shared::kRoomForAll : view->room();
        };
        for (uint32_t g = 0; g < desc.groupCount; ++g) {
            if (groupAt(g).isBudgeted() && roomOf(groupAt(g).view()) != shared::kRoomForAll) {
                groupAt(g).recordSizes(commandBuffer);
                computeBarrier();
            }
        }
        pass(Pass::list, [&](Group& group) {
            return group.view() != nullptr ? group.recordSeen(commandBuffer, roomOf(group.view())) : Group::PassCost{};
        });
        gpu::memoryBarrier(
            device, commandBuffer, {kCompute, kWrite},
            {kCompute | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, kRead | kWrite | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT});
    }
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
    if (views) {
        pass(Pass::level, [&](Group& group) { return group.recordEdgeLevels(commandBuffer); });
        computeBarrier();
        pass(Pass::level, [&](Group& group) { return group.recordPatchLevels(commandBuffer); });
        computeBarrier();
        device.beginLabel(commandBuffer, passName(Pass::solve));
        for (uint32_t g = 0; g < desc.groupCount; ++g) {
            if (firstOfView(g)) {
                timing.beginPass();
                uint32_t priorities = 0;
                for (uint32_t h = g; h < desc.groupCount; ++h) {
                    priorities |= groupAt(h).view() == groupAt(g).view() ? groupAt(h).priorities() : 0;
                }
                groupAt(g).view()->recordSolve(commandBuffer, surface_.lod(), groupAt(g).anySet(), priorities);
                timing.endPass(Pass::solve, desc.groups[g], 0, 0, groupAt(g).view());
            }
        }
        device.endLabel(commandBuffer);
        pass(Pass::place, [&](Group& group) { return group.recordPlaces(commandBuffer); });
        gpu::memoryBarrier(device, commandBuffer, {kCompute, kWrite},
                           {kCompute | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_COPY_BIT,
                            kRead | kWrite | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_TRANSFER_READ_BIT});
        for (uint32_t g = 0; g < desc.groupCount; ++g) {
            if (firstOfView(g)) {
                groupAt(g).view()->recordReadback(commandBuffer);
            }
        }
        for (uint32_t g = 0; g < desc.groupCount; ++g) {
            if (groupAt(g).view() != nullptr) {
                groupAt(g).recordReadback(commandBuffer);
            }
        }
        gpu::memoryBarrier(device, commandBuffer, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                           {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
        if (any([](Group& group) { return group.writesLodAttributes(); })) {
            pass(Pass::attributes, [&](Group& group) { return group.recordLodAttributes(commandBuffer); });
        }
    }
    pass(Pass::evaluate, [&](Group& group) { return group.recordEvaluate(commandBuffer); });
    if (any([](Group& group) { return group.writesMotion(); })) {
        if (any([](Group& group) { return group.writesMotion() && group.usesScratch(); })) {
            computeBarrier();
        }
        pass(Pass::motion, [&](Group& group) { return group.recordMotion(commandBuffer); });
    }

    if (asyncCompute_) {
        const auto release = [&](std::span<VkBufferMemoryBarrier2> transfers) {
            for (VkBufferMemoryBarrier2& barrier : transfers) {
                barrier.srcStageMask = kLast.stages;
                barrier.srcAccessMask = kLast.access;
                barrier.srcQueueFamilyIndex = queueFamily_;
                barrier.dstQueueFamilyIndex = drawQueueFamily_;
            }
            VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
            info.bufferMemoryBarrierCount = static_cast<uint32_t>(transfers.size());
            info.pBufferMemoryBarriers = transfers.data();
            device.vk.CmdPipelineBarrier2(commandBuffer, &info);
        };
        for (uint32_t g = 0; g < desc.groupCount; ++g) {
            Group::Transfers ofGroup;
            release({ofGroup.data(), groupAt(g).transfers(ofGroup)});
            if (firstOfView(g)) {
                View::Transfers ofView;
                release({ofView.data(), groupAt(g).view()->transfers(ofView)});
            }
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
    const auto acquire = [&](std::span<const VkBufferMemoryBarrier2> transfers) {
        for (const VkBufferMemoryBarrier2& barrier : transfers) {
            if (total < out.size()) {
                out[total] = barrier;
                out[total].dstStageMask = use.stages;
                out[total].dstAccessMask = use.access;
                out[total].srcQueueFamilyIndex = queueFamily_;
                out[total].dstQueueFamilyIndex = drawQueueFamily_;
            }
            ++total;
        }
    };
    for (size_t g = 0; g < wanted.size(); ++g) {
        const std::shared_ptr<Group> group = groups.find(wanted[g].id);
        Group::Transfers ofGroup;
        acquire({ofGroup.data(), group->transfers(ofGroup)});
        const bool first =
            std::none_of(wanted.begin(), wanted.begin() + static_cast<ptrdiff_t>(g),
                         [&](const SuppleGroup& h) { return groups.find(h.id)->view() == group->view(); });
        if (group->view() != nullptr && first) {
            View::Transfers ofView;
            acquire({ofView.data(), group->view()->transfers(ofView)});
        }
    }
    return total;
}

} // namespace supple::runtime
