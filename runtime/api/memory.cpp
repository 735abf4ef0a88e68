// supple.h, memory.
#include "runtime/api/entry.h"

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

namespace {

SuppleResult fillUse(Context& context, const char* function, const gpu::MemoryUse& use, SuppleMemoryUse* out,
                     VkDeviceSize givenBack = 0) {
    using gpu::MemoryPurpose;
    return describe(context, function, out, [&](SuppleMemoryUse& filled) {
        filled.allocationCount = use.allocations;
        filled.hostVisible = use.hostVisible();
        filled.deviceLocal = use.total() - filled.hostVisible;
        filled.tables = use.of(MemoryPurpose::tables);
        filled.poses = use.of(MemoryPurpose::poses);
        filled.cages = use.of(MemoryPurpose::cages);
        filled.coefficients = use.of(MemoryPurpose::coefficients);
        filled.vertices = use.of(MemoryPurpose::vertices);
        filled.streams = use.of(MemoryPurpose::streams);
        filled.lists = use.of(MemoryPurpose::lists);
        filled.scratch = use.of(MemoryPurpose::scratch);
        filled.staging = use.of(MemoryPurpose::staging);
        filled.readback = use.of(MemoryPurpose::readback);
        filled.spare = use.of(MemoryPurpose::spare);
        filled.spareVisible = use.of(MemoryPurpose::spareVisible);
        filled.givenBack = givenBack;
    });
}

} // namespace

SuppleResult suppleGetContextMemory(SuppleContext handle, SuppleMemoryUse* out) {
    constexpr const char* kHere = "suppleGetContextMemory";
    return guarded(handle, kHere, [&](Context& context) { return fillUse(context, kHere, context.memoryUse(), out); });
}

SuppleResult suppleGetAssetMemory(SuppleContext handle, SuppleAsset asset, SuppleMemoryUse* out) {
    constexpr const char* kHere = "suppleGetAssetMemory";
    return withAsset(handle, asset, kHere,
                     [&](Context& context, const Asset& own) { return fillUse(context, kHere, own.memoryUse(), out); });
}

SuppleResult suppleGetGroupMemory(SuppleContext handle, SuppleGroup group, SuppleMemoryUse* out) {
    constexpr const char* kHere = "suppleGetGroupMemory";
    return withGroup(handle, group, kHere, [&](Context& context, const Group& own) {
        return fillUse(context, kHere, own.memoryUse(), out, own.givenBackBytes());
    });
}

SuppleResult suppleGetViewMemory(SuppleContext handle, SuppleView view, SuppleMemoryUse* out) {
    constexpr const char* kHere = "suppleGetViewMemory";
    return withView(handle, view, kHere,
                    [&](Context& context, const View& own) { return fillUse(context, kHere, own.memoryUse(), out); });
}

SuppleResult suppleSetMemoryBudget(SuppleContext handle, VkDeviceSize bytes, SuppleMemoryBudgetFunction ask,
                                   void* user) {
    return guarded(handle, "suppleSetMemoryBudget", [&](Context& context) {
        std::function<bool(const gpu::MemoryRequest&)> allowsMore;
        if (ask != nullptr) {
            allowsMore = [ask, user](const gpu::MemoryRequest& request) {
                const SuppleMemoryRequest told{sizeof(SuppleMemoryRequest),
                                               request.hostVisible ? 1u : 0u,
                                               request.name,
                                               request.bytes,
                                               request.used,
                                               request.budget};
                return ask(&told, user) != 0;
            };
        }
        context.setMemoryBudget(bytes, std::move(allowsMore));
        return SUPPLE_OK;
    });
}
