// supple.h, group.
#include "runtime/api/descriptions.h"
#include "runtime/api/entry.h"

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

SuppleResult suppleCreateGroup(SuppleContext handle, const SuppleGroupDesc* given, SuppleGroup* out) {
    constexpr const char* kHere = "suppleCreateGroup";
    return onDevice(handle, kHere, [&](Context& context) {
        if (out == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "out is null");
        }
        out->id = 0;
        GivenGroup group;
        if (const std::optional<Error> fault = group.take(given)) {
            return refuse(context, fault->code, kHere, fault->message);
        }
        Result<uint64_t> id = context.createGroup(group.desc);
        if (!id) {
            return report(context, id.error());
        }
        out->id = *id;
        return noted(context, calls::CreateGroup{*out, group.desc});
    });
}

SuppleResult suppleDestroyGroup(SuppleContext handle, SuppleGroup group) {
    return guarded(handle, "suppleDestroyGroup", [&](Context& context) {
        return context.destroyGroup(group.id)
                   ? noted(context, calls::DestroyGroup{group})
                   : refuse(context, ErrorCode::staleHandle, "suppleDestroyGroup", "stale or foreign group handle");
    });
}

SuppleResult suppleSetCapacity(SuppleContext handle, SuppleGroup group, uint32_t capacity) {
    constexpr const char* kName = "suppleSetCapacity";
    return onDevice(handle, kName, [&](Context& context) {
        if (context.groups.find(group.id) == nullptr) {
            return refuse(context, ErrorCode::staleHandle, kName, "stale or foreign group handle");
        }
        if (capacity == 0) {
            return refuse(context, ErrorCode::range, kName, "capacity is 0");
        }
        return notedIf(context, context.setCapacity(group.id, capacity), calls::SetCapacity{group, capacity});
    });
}

SuppleResult suppleSetRate(SuppleContext handle, SuppleGroup group, uint32_t rate) {
    return withGroup(handle, group, "suppleSetRate", [&](Context& context, Group& found) {
        const Status set = found.setRate(rate);
        return set ? noted(context, calls::SetRate{group, rate})
                   : refuse(context, set.error().code, "suppleSetRate", set.error().message);
    });
}
