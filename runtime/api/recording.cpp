// supple_recording.h.
#include "runtime/api/entry.h"

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

SuppleResult suppleStartRecording(SuppleContext handle, const SuppleRecordingDesc* given) {
    constexpr const char* kHere = "suppleStartRecording";
    return onDevice(handle, kHere, [&](Context& context) {
        SuppleRecordingDesc desc{};
        if (const auto fault = takeIn(context, kHere, "desc", given, desc)) {
            return *fault;
        }
        if ((desc.flags & ~uint32_t{SUPPLE_RECORDING_WITHOUT_ASSETS | SUPPLE_RECORDING_HASHES}) != 0) {
            return refuse(context, ErrorCode::range, kHere, "unknown flags");
        }
        if (desc.reserved != 0) {
            return refuse(context, ErrorCode::range, kHere, "reserved is not 0");
        }
        if (desc.write == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "write is null");
        }
        return reportStatus(context, context.startRecording(desc));
    });
}

SuppleResult suppleStopRecording(SuppleContext handle) {
    return guarded(handle, "suppleStopRecording",
                   [&](Context& context) { return reportStatus(context, context.stopRecording()); });
}
