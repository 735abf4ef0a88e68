// supple_points.h.
#include "runtime/api/entry.h"
#include "runtime/points/find_points.h"

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

namespace {

constexpr const char* kCreatePointSet = "suppleCreatePointSet";

/// What can be said of a description without its group, or nothing.
std::optional<Error> faultOf(const SupplePointSetDesc& desc) {
    if (desc.points == nullptr) {
        return Error{ErrorCode::nullPointer, "desc.points is null"};
    }
    if (desc.pointCount == 0) {
        return Error{ErrorCode::range, "pointCount is 0"};
    }
    if ((desc.flags & ~uint32_t{SUPPLE_POINT_SET_ON_VERTICES}) != 0 ||
        !within(desc.format, SUPPLE_POINT_DERIVATIVES_32)) {
        return Error{ErrorCode::range, "flags must be SupplePointSetFlags, format one of SupplePointFormat"};
    }
    if (desc.flags != 0 && desc.format == SUPPLE_POINT_DERIVATIVES_32) {
        return Error{ErrorCode::argument, "SUPPLE_POINT_DERIVATIVES_32 has no positions for "
                                          "SUPPLE_POINT_SET_ON_VERTICES"};
    }
    if (desc.tangents != nullptr && !finite(desc.tangents, 3 * size_t{desc.pointCount})) {
        return Error{ErrorCode::notFinite, "tangents must be finite"};
    }
    return std::nullopt;
}

constexpr const char* kFindPoints = "suppleFindPoints";

/// What is wrong with the numbers of a query.
std::optional<Error> faultOfValues(const SupplePointQuery& query) {
    if (query.values == nullptr) {
        return std::nullopt;
    }
    const size_t each = query.kind == SUPPLE_FIND_RAY ? 6 : query.kind == SUPPLE_FIND_NEAREST ? 3 : 2;
    const auto isSound = [](float x) { return std::abs(x) <= SUPPLE_MAX_COORDINATE; };
    if (!std::all_of(query.values, query.values + each * query.count, isSound)) {
        return Error{ErrorCode::notFinite, "values must be finite and within SUPPLE_MAX_COORDINATE"};
    }
    for (size_t ray = 0; query.kind == SUPPLE_FIND_RAY && ray < query.count; ++ray) {
        const float* const direction = query.values + 6 * ray + 3;
        if (direction[0] == 0.0f && direction[1] == 0.0f && direction[2] == 0.0f) {
            return Error{ErrorCode::range, "ray " + std::to_string(ray) + " has a direction without a length"};
        }
    }
    return std::nullopt;
}

/// The same of a query.
std::optional<Error> faultOf(const SupplePointQuery& query) {
    const bool isUv = query.kind == SUPPLE_FIND_UV, isScatter = query.kind == SUPPLE_FIND_SCATTER;
    const bool isGltf = query.kind == SUPPLE_FIND_GLTF, isGiven = query.kind == SUPPLE_FIND_GIVEN;
    if (!within(query.kind, SUPPLE_FIND_GIVEN) || query.uvSet > (isUv ? 1u : 0u) || (query.seed != 0 && !isScatter) ||
        (query.pointsEach != 0 && !isUv) || query.reserved != 0) {
        return Error{ErrorCode::range,
                     "kind must be one of SupplePointQueryKind, uvSet, seed and pointsEach what it takes"};
    }
    if (isScatter || isGltf || isGiven ? query.values != nullptr : query.values == nullptr && query.count > 0) {
        return Error{ErrorCode::nullPointer, "values must be there for NEAREST, UV and RAY, and null for all others"};
    }
    if (isGltf ? query.gltf == nullptr && query.count > 0 : query.gltf != nullptr) {
        return Error{ErrorCode::nullPointer, "gltf must be there for GLTF, and null for all others"};
    }
    if (isGiven && query.jets == nullptr && query.count > 0) {
        return Error{ErrorCode::nullPointer, "jets must be there for GIVEN"};
    }
    if ((query.cage == nullptr) != (query.cageVertexCount == 0)) {
        return Error{ErrorCode::nullPointer, "cage and cageVertexCount do not agree"};
    }
    if (query.cage != nullptr && (isUv || isGltf)) {
        return Error{ErrorCode::argument, "UV and GLTF take no cage: they are of the file"};
    }
    if (runtime::pointsOf(query) > UINT32_MAX) {
        return Error{ErrorCode::range, "count times pointsEach is more than 32 bits number"};
    }
    return faultOfValues(query);
}

} // namespace

SuppleResult suppleFindPoints(SuppleContext handle, SuppleGroup group, const SupplePointQuery* given,
                              SuppleSurfacePoint* out) {
    return withGroup(handle, group, kFindPoints, [&](Context& context, Group& found) {
        SupplePointQuery query{};
        if (const auto fault = takeIn(context, kFindPoints, "query", given, query)) {
            return *fault;
        }
        if (const std::optional<Error> fault = faultOf(query)) {
            return refuse(context, found, fault->code, kFindPoints, fault->message);
        }
        if (out == nullptr && query.count > 0) {
            return refuse(context, found, ErrorCode::nullPointer, kFindPoints, "out is null");
        }
        const auto surfaces = Context::surfacesOf(found);
        const Status status = surfaces
                                  ? runtime::findPoints(*surfaces, found.points().finder(), query,
                                                        std::span(out, static_cast<size_t>(runtime::pointsOf(query))))
                                  : Status(surfaces.error());
        return status ? SUPPLE_OK : refuse(context, found, status.error().code, kFindPoints, status.error().message);
    });
}

SuppleResult suppleCreatePointSet(SuppleContext handle, const SupplePointSetDesc* given, SupplePointSet* out) {
    return onDevice(handle, kCreatePointSet, [&](Context& context) {
        if (out == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kCreatePointSet, "out is null");
        }
        out->id = 0;
        SupplePointSetDesc desc{};
        if (const auto fault = takeIn(context, kCreatePointSet, "desc", given, desc)) {
            return *fault;
        }
        if (const std::optional<Error> fault = faultOf(desc)) {
            return refuse(context, fault->code, kCreatePointSet, fault->message);
        }
        if (context.groups.find(desc.group.id) == nullptr) {
            return refuse(context, ErrorCode::staleHandle, kCreatePointSet, "stale or foreign group handle");
        }
        const Result<uint64_t> id = context.createPointSet(desc);
        if (!id) {
            return report(context, id.error());
        }
        out->id = *id;
        return noted(context, calls::CreatePointSet{*out, desc});
    });
}

SuppleResult suppleDestroyPointSet(SuppleContext handle, SupplePointSet set) {
    constexpr const char* kHere = "suppleDestroyPointSet";
    return guarded(handle, kHere, [&](Context& context) {
        const std::shared_ptr<runtime::PointSet> found = context.pointSets.find(set.id);
        if (found == nullptr) {
            return refuse(context, ErrorCode::staleHandle, kHere, "stale or foreign point set handle");
        }
        context.destroyPointSet(set.id);
        return noted(context, calls::DestroyPointSet{set, {found->group()}});
    });
}

SuppleResult suppleGetPointOutput(SuppleContext handle, SupplePointSet set, SupplePointOutput* out) {
    constexpr const char* kHere = "suppleGetPointOutput";
    return guarded(handle, kHere, [&](Context& context) {
        const std::shared_ptr<runtime::PointSet> found = context.pointSets.find(set.id);
        if (found == nullptr) {
            return refuse(context, ErrorCode::staleHandle, kHere, "stale or foreign point set handle");
        }
        context.groups.find(found->group())->noteOutputsAsked();
        return describe(context, kHere, out, [&](SupplePointOutput& output) { found->fill(output); });
    });
}
