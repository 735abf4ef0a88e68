// supple.h, output; supple_rays.h; supple_direct.h.
#include "runtime/api/entry.h"
#include "runtime/api/patches.h"

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

SuppleResult suppleGetGroupInfo(SuppleContext handle, SuppleGroup group, SuppleGroupInfo* out) {
    constexpr const char* kHere = "suppleGetGroupInfo";
    return withGroup(handle, group, kHere, [&](Context& context, Group& found) {
        return describe(context, kHere, out, [&](SuppleGroupInfo& info) { found.fill(info); });
    });
}

SuppleResult suppleGetSurfaceInfo(SuppleContext handle, SuppleGroup group, uint32_t surface, SuppleSurfaceInfo* out) {
    constexpr const char* kHere = "suppleGetSurfaceInfo";
    return withSurface(handle, group, surface, kHere, [&](Context& context, Group& found, const Tessellation&) {
        return describe(context, kHere, out, [&](SuppleSurfaceInfo& info) { found.fill(info, surface); });
    });
}

SuppleResult suppleGetVertexStreams(SuppleContext handle, SuppleGroup group, uint32_t surface,
                                    SuppleVertexStreams* out) {
    constexpr const char* kHere = "suppleGetVertexStreams";
    return withSurface(handle, group, surface, kHere, [&](Context& context, Group& group, const Tessellation& found) {
        const runtime::VertexStreams* streams = found.streams();
        if (streams == nullptr) {
            return refuse(context, group, ErrorCode::argument, kHere, "a cage has no surface vertices");
        }
        group.noteOutputsAsked();
        return describe(context, kHere, out, [&](SuppleVertexStreams& output) { streams->fill(output); });
    });
}

SuppleResult suppleGetGridOutput(SuppleContext handle, SuppleGroup group, uint32_t surface, SuppleGridOutput* out) {
    constexpr const char* kHere = "suppleGetGridOutput";
    return withSurface(handle, group, surface, kHere, [&](Context& context, Group& group, const Tessellation& found) {
        if (found.kind() == SUPPLE_TESSELLATION_NONE || found.kind() == SUPPLE_TESSELLATION_LEVELS) {
            return refuse(context, group, ErrorCode::argument, kHere, "the surface has no grids of a rate");
        }
        group.noteOutputsAsked();
        return describe(context, kHere, out, [&](SuppleGridOutput& output) { found.fillGrid(output); });
    });
}

SuppleResult suppleGetDirectOutput(SuppleContext handle, SuppleGroup group, uint32_t surface, SuppleDirectOutput* out) {
    constexpr const char* kHere = "suppleGetDirectOutput";
    return withSurface(handle, group, surface, kHere, [&](Context& context, Group& group, const Tessellation& found) {
        if (found.kind() != SUPPLE_TESSELLATION_DIRECT) {
            return refuse(context, group, ErrorCode::argument, kHere,
                          "the surface is not evaluated while it is drawn (SUPPLE_GROUP_DIRECT)");
        }
        group.noteOutputsAsked();
        return describe(context, kHere, out, [&](SuppleDirectOutput& output) { found.fillDirect(output); });
    });
}

SuppleResult suppleGetRayGeometry(SuppleContext handle, SuppleGroup group, uint32_t surface, SuppleRayGeometry* out) {
    constexpr const char* kHere = "suppleGetRayGeometry";
    return withSurface(handle, group, surface, kHere, [&](Context& context, Group& group, const Tessellation& found) {
        if (!found.isTraced()) {
            return refuse(context, group, ErrorCode::argument, kHere, "the group lacks SUPPLE_GROUP_RAY_TRACING");
        }
        group.noteOutputsAsked();
        return describe(context, kHere, out, [&](SuppleRayGeometry& geometry) { found.fillRays(geometry); });
    });
}

SuppleResult suppleGetPatches(SuppleContext handle, SuppleGroup group, uint32_t surface, SupplePatchInfo* out,
                              uint32_t* count) {
    return withSurface(handle, group, surface, "suppleGetPatches",
                       [&](Context& context, Group&, const Tessellation& found) {
                           if (count == nullptr) {
                               return refuse(context, ErrorCode::nullPointer, "suppleGetPatches", "count is null");
                           }
                           return fillPatches(found.tables().patches, out, count);
                       });
}
