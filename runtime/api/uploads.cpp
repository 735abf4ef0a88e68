// supple.h, the budget of uploads.
#include "runtime/api/entry.h"

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

SuppleResult suppleSetUploadBudget(SuppleContext handle, VkDeviceSize bytesPerFrame) {
    return onDevice(handle, "suppleSetUploadBudget", [&](Context& context) {
        return notedIf(context, context.setUploadBudget(bytesPerFrame), calls::SetUploadBudget{bytesPerFrame});
    });
}

SuppleResult suppleGetUploadState(SuppleContext handle, SuppleUploadState* out) {
    constexpr const char* kHere = "suppleGetUploadState";
    return guarded(handle, kHere, [&](Context& context) {
        return describe(context, kHere, out, [&](SuppleUploadState& state) { state = context.uploadState(); });
    });
}

SuppleResult suppleGetAssetUploadState(SuppleContext handle, SuppleAsset asset, SuppleUploadState* out) {
    constexpr const char* kHere = "suppleGetAssetUploadState";
    return withAsset(handle, asset, kHere, [&](Context& context, Asset& found) {
        return describe(context, kHere, out, [&](SuppleUploadState& state) { state = context.uploadState(found); });
    });
}

SuppleResult suppleGetGroupUploadState(SuppleContext handle, SuppleGroup group, SuppleUploadState* out) {
    constexpr const char* kHere = "suppleGetGroupUploadState";
    return withGroup(handle, group, kHere, [&](Context& context, const Group& found) {
        return describe(context, kHere, out, [&](SuppleUploadState& state) { state = context.uploadState(found); });
    });
}
