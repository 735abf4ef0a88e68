// supple.h, group.
#include "runtime/api/descriptions.h"
#include "runtime/api/entry.h"

#include <algorithm>
#include <cmath>

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

SuppleResult suppleSetWind(SuppleContext handle, SuppleGroup group, const float* wind) {
    constexpr const char* kHere = "suppleSetWind";
    return withGroup(handle, group, kHere, [&](Context& context, Group& found) {
        if (wind == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "wind is null");
        }
        if (!finite(wind, 3)) {
            return refuse(context, found, ErrorCode::notFinite, kHere, "wind is not finite");
        }
        if (std::any_of(wind, wind + 3, [](float axis) { return std::abs(axis) > SUPPLE_MAX_WIND; })) {
            return refuse(context, found, ErrorCode::range, kHere, "wind is beyond SUPPLE_MAX_WIND");
        }
        if (found.follows()) {
            return refuse(context, found, ErrorCode::argument, kHere,
                          "the group draws the instances of another one: set the wind of that one");
        }
        found.poses().setWind({wind[0], wind[1], wind[2]});
        return noted(context, calls::SetWind{group, {wind[0], wind[1], wind[2]}});
    });
}

SuppleResult suppleSetRate(SuppleContext handle, SuppleGroup group, uint32_t rate) {
    return withGroup(handle, group, "suppleSetRate", [&](Context& context, Group& found) {
        const Status set = found.setRate(rate);
        return set ? noted(context, calls::SetRate{group, rate})
                   : refuse(context, set.error().code, "suppleSetRate", set.error().message);
    });
}
