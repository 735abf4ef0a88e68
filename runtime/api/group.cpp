// supple.h, group.
#include "runtime/api/entry.h"
#include "runtime/vertex_streams.h"
#include "surface/schemes.h"

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

namespace {

constexpr const char* kHere = "suppleCreateGroup";
constexpr uint32_t kGroupFlags = runtime::streamFlags(&runtime::StreamRow::groupFlag) | SUPPLE_GROUP_PATCHES |
                                 SUPPLE_GROUP_INDEXED_MESH | SUPPLE_GROUP_ONE_LEVEL | SUPPLE_GROUP_BOUNDS |
                                 SUPPLE_GROUP_WINDOWS;

/// Copies the options that desc points to, and lets it point to the copies. Null if they are sound.
std::optional<SuppleResult> takeSchemeOptions(Context& context, SuppleGroupDesc& desc, SupplePrepOptions& prep,
                                              SuppleBlendOptions& blend) {
    if (desc.prep != nullptr) {
        if (const auto fault = takeIn(context, kHere, "prep", desc.prep, prep)) {
            return fault;
        }
        desc.prep = &prep;
    }
    if (desc.blend != nullptr) {
        if (const auto fault = takeIn(context, kHere, "blend", desc.blend, blend)) {
            return fault;
        }
        desc.blend = &blend;
    }
    if (!within(prep.tangentMode, SUPPLE_TANGENTS_PRINTED) || !within(prep.cornerRule, SUPPLE_CORNERS_SMOOTH) ||
        !within(blend.creaseMode, SUPPLE_CREASES_CURVE)) {
        return refuse(context, ErrorCode::range, kHere, "no such tangentMode, cornerRule or creaseMode");
    }
    if (std::isnan(blend.sharpThreshold)) {
        return refuse(context, ErrorCode::notFinite, kHere, "sharpThreshold is NaN");
    }
    if (blend.sharpThreshold < 0.0f) {
        return refuse(context, ErrorCode::range, kHere, "sharpThreshold is negative");
    }
    return std::nullopt;
}

/// Null if all are schemes of surfaces.
std::optional<SuppleResult> checkPartSchemes(Context& context, const SuppleGroupDesc& desc) {
    if (desc.partSchemeCount > 0 && desc.partSchemes == nullptr) {
        return refuse(context, ErrorCode::nullPointer, kHere, "partSchemes is null");
    }
    if (desc.partSchemeCount > 0 && desc.scheme == SUPPLE_SCHEME_CAGE) {
        return refuse(context, ErrorCode::argument, kHere, "a cage has no surfaces of parts");
    }
    for (uint32_t part = 0; part < desc.partSchemeCount; ++part) {
        if (runtime::rawValue(desc.partSchemes[part]) > surface::schemes().size()) {
            return refuse(context, ErrorCode::range, kHere,
                          "partSchemes[" + std::to_string(part) + "]: no such scheme of a surface");
        }
    }
    return std::nullopt;
}

/// Null if the flags go with each other and with the rest.
std::optional<SuppleResult> checkFlags(Context& context, const SuppleGroupDesc& desc) {
    const auto has = [&](uint32_t flag) { return (desc.flags & flag) != 0; };
    if (has(~kGroupFlags)) {
        return refuse(context, ErrorCode::range, kHere, "unknown flags");
    }
    if (desc.view.id != 0 && has(~uint32_t{SUPPLE_GROUP_ONE_LEVEL | SUPPLE_GROUP_BOUNDS})) {
        return refuse(context, ErrorCode::argument, kHere,
                      "a group of a view takes the flags ONE_LEVEL and BOUNDS alone: the view has the others");
    }
    if (desc.view.id == 0 && has(SUPPLE_GROUP_ONE_LEVEL)) {
        return refuse(context, ErrorCode::argument, kHere, "SUPPLE_GROUP_ONE_LEVEL without a view");
    }
    if (has(SUPPLE_GROUP_INDEXED_MESH) && desc.scheme == SUPPLE_SCHEME_CAGE) {
        return refuse(context, ErrorCode::argument, kHere, "a cage has no samples to share");
    }
    if (has(SUPPLE_GROUP_TANGENTS) && !has(SUPPLE_GROUP_ATTRIBUTES)) {
        return refuse(context, ErrorCode::argument, kHere, "TANGENTS go with ATTRIBUTES");
    }
    return std::nullopt;
}

/// Null if it says whose instances they are, and how many.
std::optional<SuppleResult> checkInstances(Context& context, const SuppleGroupDesc& desc) {
    if (desc.instancesOf.id != 0 &&
        (desc.capacity != 0 || runtime::rawValue(desc.skinning) != 0 || runtime::rawValue(desc.poseSource) != 0)) {
        return refuse(context, ErrorCode::argument, kHere,
                      "capacity, skinning and poseSource are those of instancesOf: they must be 0");
    }
    if (desc.capacity == 0 && desc.instancesOf.id == 0) {
        return refuse(context, ErrorCode::range, kHere, "capacity is 0");
    }
    return std::nullopt;
}

} // namespace

SuppleResult suppleCreateGroup(SuppleContext handle, const SuppleGroupDesc* given, SuppleGroup* out) {
    return onDevice(handle, kHere, [&](Context& context) {
        if (out == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "out is null");
        }
        out->id = 0;
        SuppleGroupDesc desc{};
        if (const auto fault = takeIn(context, kHere, "desc", given, desc)) {
            return *fault;
        }
        if (const auto fault = checkInstances(context, desc)) {
            return *fault;
        }
        if (desc.rate > SUPPLE_MAX_RATE) {
            return refuse(context, ErrorCode::range, kHere, "rate must be 1..64");
        }
        if (runtime::rawValue(desc.scheme) > surface::schemes().size() &&
            runtime::rawValue(desc.scheme) != SUPPLE_SCHEME_CAGE) {
            return refuse(context, ErrorCode::range, kHere, "no such scheme");
        }
        if (!within(desc.vertexFormat, SUPPLE_VERTEX_24) || !within(desc.skinning, SUPPLE_SKINNING_DUAL_QUATERNION) ||
            !within(desc.poseSource, SUPPLE_POSES_PLAYBACK)) {
            return refuse(context, ErrorCode::range, kHere, "no such vertexFormat, skinning or poseSource");
        }
        if (!within(desc.uvInterpolation, SUPPLE_UV_LINEAR_ALL)) {
            return refuse(context, ErrorCode::range, kHere, "no such uvInterpolation");
        }
        if (const auto fault = checkFlags(context, desc)) {
            return *fault;
        }
        SupplePrepOptions prep{};
        SuppleBlendOptions blend{};
        if (const auto fault = takeSchemeOptions(context, desc, prep, blend)) {
            return *fault;
        }
        if (desc.poseSource == SUPPLE_POSES_PALETTE_BUFFER && desc.skinning != SUPPLE_SKINNING_LINEAR) {
            return refuse(context, ErrorCode::argument, kHere, "a palette buffer goes with linear skinning only");
        }
        if (const auto fault = checkPartSchemes(context, desc)) {
            return *fault;
        }
        if (desc.view.id != 0 && desc.scheme == SUPPLE_SCHEME_CAGE) {
            return refuse(context, ErrorCode::argument, kHere, "a cage has no levels of detail");
        }
        Result<uint64_t> id = context.createGroup(desc);
        if (!id) {
            return report(context, id.error());
        }
        out->id = *id;
        return SUPPLE_OK;
    });
}

SuppleResult suppleDestroyGroup(SuppleContext handle, SuppleGroup group) {
    return guarded(handle, "suppleDestroyGroup", [&](Context& context) {
        return context.destroyGroup(group.id)
                   ? SUPPLE_OK
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
        return reportStatus(context, context.setCapacity(group.id, capacity));
    });
}

SuppleResult suppleSetRate(SuppleContext handle, SuppleGroup group, uint32_t rate) {
    return withGroup(handle, group, "suppleSetRate", [&](Context& context, Group& found) {
        const Status set = found.setRate(rate);
        return set ? SUPPLE_OK : refuse(context, set.error().code, "suppleSetRate", set.error().message);
    });
}
