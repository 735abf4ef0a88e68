// One frame, as the data flows: upload, deform, vertex, edge, patch, evaluate.
#include "runtime/context.h"

namespace supple::runtime {

namespace {

using surface::Stage;

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kTransfer = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
constexpr VkAccessFlags2 kRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
constexpr VkAccessFlags2 kWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;

} // namespace

Status Context::record(VkCommandBuffer commandBuffer, const SuppleRecordDesc& desc) {
    if (frame_ == 0) {
        return Error{ErrorCode::argument, "suppleRecord before suppleBeginFrame"};
    }
    for (uint32_t g = 0; g < desc.groupCount; ++g) {
        const std::shared_ptr<Group>& group = groups.find(desc.groups[g].id);
        if (group == nullptr) {
            return Error{ErrorCode::argument, "suppleRecord: group " + std::to_string(g) + ": stale or foreign handle"};
        }
        if (group->lastRecordedFrame() == frame_) {
            return Error{ErrorCode::argument, "suppleRecord: group " + std::to_string(g) +
                                                  ": recorded twice in frame " + std::to_string(frame_)};
        }
        for (uint32_t h = 0; h < g; ++h) {
            if (desc.groups[h].id == desc.groups[g].id) {
                return Error{ErrorCode::argument, "suppleRecord: group " + std::to_string(g) + ": listed twice"};
            }
        }
    }

    const gpu::Device& device = *device_;
    Status status = success();
    // One pass over all groups: labelled, timed per group.
    const auto pass = [&](const char* name, auto&& recordGroup) {
        device.beginLabel(commandBuffer, name);
        for (uint32_t g = 0; g < desc.groupCount; ++g) {
            Group& group = *groups.find(desc.groups[g].id);
            timings.beginPass();
            const Group::PassCost cost = recordGroup(group);
            if (cost.bytes > 0) {
                timings.endPass(commandBuffer, name, g, cost.points, cost.bytes);
            }
        }
        device.endLabel(commandBuffer);
    };
    const auto any = [&](auto&& predicate) {
        for (uint32_t g = 0; g < desc.groupCount; ++g) {
            if (predicate(*groups.find(desc.groups[g].id))) {
                return true;
            }
        }
        return false;
    };
    const auto computeBarrier = [&] {
        gpu::memoryBarrier(device, commandBuffer, {kCompute, kWrite}, {kCompute, kRead | kWrite});
    };

    device.beginLabel(commandBuffer, "supple");
    // Earlier frames' passes and the host's uses end before this frame overwrites anything.
    gpu::memoryBarrier(
        device, commandBuffer,
        {desc.before.stages | kCompute | kTransfer, desc.before.access | kWrite | VK_ACCESS_2_TRANSFER_WRITE_BIT},
        {kCompute | kTransfer, kRead | kWrite | VK_ACCESS_2_TRANSFER_WRITE_BIT});
    timings.open(commandBuffer, (desc.flags & SUPPLE_RECORD_TIMINGS) != 0);

    pass("upload", [&](Group& group) {
        Result<Group::PassCost> cost = group.recordUpload(commandBuffer, frame_);
        if (cost) {
            cost->bytes += pairs_.recordUpload(commandBuffer, frame_); // the first frame's first group pays for it
            return *cost;
        }
        status = cost.error();
        return Group::PassCost{};
    });
    gpu::memoryBarrier(device, commandBuffer, {kTransfer, VK_ACCESS_2_TRANSFER_WRITE_BIT}, {kCompute, kRead | kWrite});

    if (any([](Group& group) { return group.attributesPending(); })) {
        pass("attributes", [&](Group& group) { return group.recordAttributes(commandBuffer); });
    }
    pass("deform", [&](Group& group) { return group.recordDeform(commandBuffer); });
    computeBarrier();
    for (const Stage stage : {Stage::vertex, Stage::edge}) {
        if (any([&](Group& group) { return group.tables().has(stage); })) {
            pass(stage == Stage::vertex ? "vertex" : "edge",
                 [&](Group& group) { return group.recordStage(commandBuffer, stage); });
            computeBarrier();
        }
    }
    if (any([](Group& group) { return group.writesPatches(); })) {
        pass("patch", [&](Group& group) {
            return group.writesPatches() ? group.recordPatch(commandBuffer) : Group::PassCost{};
        });
    }
    pass("evaluate", [&](Group& group) { return group.recordEvaluate(commandBuffer); });

    if (desc.after.stages != 0) {
        gpu::memoryBarrier(device, commandBuffer, {kCompute | kTransfer, kWrite | VK_ACCESS_2_TRANSFER_WRITE_BIT},
                           {desc.after.stages, desc.after.access});
    }
    device.endLabel(commandBuffer);
    return status;
}

} // namespace supple::runtime
