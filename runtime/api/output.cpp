// supple.h, output.
#include "runtime/api/entry.h"

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

SuppleResult suppleGetGroupOutput(SuppleContext handle, SuppleGroup group, SuppleGroupOutput* out) {
    return withGroup(handle, group, "suppleGetGroupOutput", [&](Context& context, Group& found) {
        return describe(context, "suppleGetGroupOutput", out,
                        [&](SuppleGroupOutput& output) { output = found.output(); });
    });
}

SuppleResult suppleGetPatches(SuppleContext handle, SuppleGroup group, SupplePatchInfo* out, uint32_t* count) {
    return withGroup(handle, group, "suppleGetPatches", [&](Context& context, Group& found) {
        if (count == nullptr) {
            return refuse(context, ErrorCode::nullPointer, "suppleGetPatches", "count is null");
        }
        const auto& patches = found.tables().patches;
        const auto total = static_cast<uint32_t>(patches.size());
        const uint32_t n = out == nullptr ? 0 : std::min(*count, total);
        for (uint32_t i = 0; i < n; ++i) {
            out[i].face = patches[i].face;
            out[i].patchClass = static_cast<SupplePatchClass>(patches[i].patchClass);
            out[i].cornerCount = patches[i].cornerCount;
            out[i].coefficientCount = surface::rowOf(patches[i].patchClass).coefficients;
            std::copy(patches[i].corners.begin(), patches[i].corners.end(), out[i].corners);
        }
        *count = total;
        return out != nullptr && n < total ? SUPPLE_INCOMPLETE : SUPPLE_OK;
    });
}
