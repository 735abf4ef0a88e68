// supple.h, instance.
#include "runtime/api/entry.h"
#include "surface/pm/mesh.h"

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

SuppleResult suppleCreateInstance(SuppleContext handle, SuppleGroup group, SuppleInstance* out) {
    constexpr const char* kHere = "suppleCreateInstance";
    return withGroup(handle, group, kHere, [&](Context& context, Group& found) {
        if (out == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "out is null");
        }
        *out = {};
        if (found.follows()) {
            return refuse(context, ErrorCode::argument, kHere,
                          found.asset().character.name + ": the group draws the instances of another one");
        }
        const std::optional<uint32_t> slot = found.slots().create();
        if (!slot) {
            return refuse(context, found, ErrorCode::limit, kHere,
                          "the group is full: its capacity is " + std::to_string(found.slots().capacity()));
        }
        found.instances().reset(*slot);
        *out = {group, *slot, found.slots().generation(*slot)};
        return noted(context, calls::CreateInstance{*out});
    });
}

SuppleResult suppleDestroyInstance(SuppleContext handle, SuppleInstance instance) {
    return withInstance(handle, instance, "suppleDestroyInstance", [&](Context& context, Group& found) {
        found.slots().destroy(instance.slot);
        return noted(context, calls::DestroyInstance{instance});
    });
}

SuppleResult suppleSetVisible(SuppleContext handle, SuppleInstance instance, uint32_t visible) {
    return withInstance(handle, instance, "suppleSetVisible", [&](Context& context, Group& found) {
        if (visible > 1) {
            return refuse(context, found, ErrorCode::range, "suppleSetVisible", "visible must be 0 or 1");
        }
        found.slots().setVisible(instance.slot, visible == 1);
        return noted(context, calls::SetVisible{instance, visible});
    });
}

SuppleResult suppleSetPartVisible(SuppleContext handle, SuppleInstance instance, uint32_t part, uint32_t visible) {
    constexpr const char* kHere = "suppleSetPartVisible";
    return withInstance(handle, instance, kHere, [&](Context& context, Group& found) {
        const size_t parts = found.asset().character.parts.size();
        if (part >= parts) {
            return refuse(context, found, ErrorCode::range, kHere,
                          "part " + std::to_string(part) + " of " + std::to_string(parts));
        }
        if (visible > 1) {
            return refuse(context, found, ErrorCode::range, kHere, "visible must be 0 or 1");
        }
        if (visible == 0 && !context.hidesInDraws() && context.drawsByRanges(found.instances())) {
            return refuse(context, found, ErrorCode::disabled, kHere,
                          "the device was created without the feature drawIndirectFirstInstance");
        }
        found.slots().setPartVisible(instance.slot, part, visible == 1);
        return noted(context, calls::SetPartVisible{instance, part, visible});
    });
}

SuppleResult suppleTeleport(SuppleContext handle, SuppleInstance instance) {
    return withInstance(handle, instance, "suppleTeleport", [&](Context& context, Group& found) {
        found.slots().forget(instance.slot);
        found.poses().teleport(instance.slot);
        return noted(context, calls::Teleport{instance});
    });
}

SuppleResult suppleSetSharpness(SuppleContext handle, SuppleInstance instance, uint32_t set, float sharpness) {
    constexpr const char* kHere = "suppleSetSharpness";
    return withInstance(handle, instance, kHere, [&](Context& context, Group& found) {
        const size_t sets = found.asset().character.cage.creaseSets.size();
        if (set >= sets) {
            return refuse(context, found, ErrorCode::range, kHere,
                          "crease set " + std::to_string(set) + " of " + std::to_string(sets));
        }
        const bool own = sharpness == SUPPLE_FILE_SHARPNESS;
        if (!own && !(sharpness >= SUPPLE_LEAST_SHARPNESS)) {
            return refuse(context, found, std::isnan(sharpness) ? ErrorCode::notFinite : ErrorCode::range, kHere,
                          "sharpness is below SUPPLE_LEAST_SHARPNESS");
        }
        // Most of the time it is the group itself, which takes no look at all others.
        const bool drawsPm =
            found.surfaces().any([](const Tessellation& surface) { return surface.schemeId() == SUPPLE_SCHEME_PM; });
        if (!drawsPm && !context.draws(found.instances(), SUPPLE_SCHEME_PM)) {
            return refuse(context, found, ErrorCode::argument, kHere,
                          "no group draws the instance with SUPPLE_SCHEME_PM, and the tables of other schemes hold the "
                          "sharpness of the file");
        }
        const double alpha = surface::pm::alphaOfSharpness(sharpness);
        found.instances().setCreaseAlpha(instance.slot, set, own ? -1.0f : static_cast<float>(alpha));
        return noted(context, calls::SetSharpness{instance, set, sharpness});
    });
}

SuppleResult suppleSetUserData(SuppleContext handle, SuppleInstance instance, const float* data) {
    constexpr const char* kHere = "suppleSetUserData";
    return withInstance(handle, instance, kHere, [&](Context& context, Group& found) {
        if (data == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "data is null");
        }
        found.instances().userData().set(instance.slot, {data[0], data[1], data[2], data[3]});
        return noted(context, calls::SetUserData{instance, {data[0], data[1], data[2], data[3]}});
    });
}
