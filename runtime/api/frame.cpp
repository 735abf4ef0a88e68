// supple.h, frame.
#include "runtime/api/entry.h"

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

SuppleResult suppleBeginFrame(SuppleContext handle, uint64_t frame, uint64_t completedFrame) {
    return onDevice(handle, "suppleBeginFrame", [&](Context& context) {
        const Status begun = context.beginFrame(frame, completedFrame);
        const SuppleResult result = notedIf(context, begun, calls::BeginFrame{frame, completedFrame});
        context.flushRecording();
        return result;
    });
}

SuppleResult suppleCancelFrame(SuppleContext handle) {
    return guarded(handle, "suppleCancelFrame",
                   [&](Context& context) { return notedIf(context, context.cancelFrame(), calls::CancelFrame{}); });
}

SuppleResult suppleSetOrigin(SuppleContext handle, const double* origin) {
    constexpr const char* kHere = "suppleSetOrigin";
    return guarded(handle, kHere, [&](Context& context) {
        if (origin == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "origin is null");
        }
        if (!finite(origin, 3)) {
            return refuse(context, ErrorCode::notFinite, kHere, "origin is not finite");
        }
        context.setOrigin({origin[0], origin[1], origin[2]});
        return noted(context, calls::SetOrigin{{origin[0], origin[1], origin[2]}});
    });
}

SuppleResult suppleRecordUploads(SuppleContext handle, VkCommandBuffer commandBuffer) {
    return onDevice(handle, "suppleRecordUploads", [&](Context& context) {
        if (commandBuffer == VK_NULL_HANDLE) {
            return refuse(context, ErrorCode::nullPointer, "suppleRecordUploads", "commandBuffer is null");
        }
        return notedIf(context, context.recordUploads(commandBuffer), calls::RecordUploads{});
    });
}

SuppleResult suppleRecordWarmUp(SuppleContext handle, VkCommandBuffer commandBuffer, const SuppleGroup* groups,
                                uint32_t groupCount) {
    constexpr const char* kHere = "suppleRecordWarmUp";
    return onDevice(handle, kHere, [&](Context& context) {
        if (commandBuffer == VK_NULL_HANDLE || (groups == nullptr && groupCount > 0)) {
            return refuse(context, ErrorCode::nullPointer, kHere, "commandBuffer or groups is null");
        }
        return notedIf(context, context.recordWarmUp(commandBuffer, {groups, groupCount}),
                       calls::RecordWarmUp{groups, groupCount});
    });
}

SuppleResult suppleRecord(SuppleContext handle, VkCommandBuffer commandBuffer, const SuppleRecordDesc* given) {
    constexpr const char* kHere = "suppleRecord";
    return onDevice(handle, kHere, [&](Context& context) {
        if (commandBuffer == VK_NULL_HANDLE) {
            return refuse(context, ErrorCode::nullPointer, kHere, "commandBuffer is null");
        }
        SuppleRecordDesc desc{};
        if (const auto fault = takeIn(context, kHere, "desc", given, desc)) {
            return *fault;
        }
        if (desc.groupCount > 0 && desc.groups == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "groups is null");
        }
        if ((desc.flags & ~uint32_t{SUPPLE_RECORD_TIMINGS | SUPPLE_RECORD_NO_ENTRY_BARRIER}) != 0) {
            return refuse(context, ErrorCode::range, kHere, "unknown flags");
        }
        if (!std::isfinite(desc.time)) {
            return refuse(context, ErrorCode::notFinite, kHere, "time is not finite");
        }
        if (std::abs(desc.time) > SUPPLE_MAX_TIME) {
            return refuse(context, ErrorCode::range, kHere, "time is beyond SUPPLE_MAX_TIME");
        }
        return notedIf(context, context.record(commandBuffer, desc),
                       calls::Record{desc.groups, desc.groupCount, desc.time});
    });
}

SuppleResult suppleGetRecordScopes(SuppleSyncScope* first, SuppleSyncScope* last) {
    if (first != nullptr) {
        *first = Context::firstScope();
    }
    if (last != nullptr) {
        *last = Context::lastScope();
    }
    return SUPPLE_OK;
}

SuppleResult suppleGetAcquireBarriers(SuppleContext handle, const SuppleGroup* groups, uint32_t groupCount,
                                      SuppleSyncScope use, VkBufferMemoryBarrier2* out, uint32_t* count) {
    constexpr const char* kHere = "suppleGetAcquireBarriers";
    return guarded(handle, kHere, [&](Context& context) {
        if (count == nullptr || (groups == nullptr && groupCount > 0)) {
            return refuse(context, ErrorCode::nullPointer, kHere, "count or groups is null");
        }
        const uint32_t room = out == nullptr ? 0 : *count;
        const Result<uint32_t> total = context.acquireBarriers({groups, groupCount}, use, {out, room});
        if (!total) {
            return report(context, total.error());
        }
        *count = *total;
        return out != nullptr && room < *total ? SUPPLE_INCOMPLETE : SUPPLE_OK;
    });
}
