// supple.h, output.
#include "runtime/api/entry.h"

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

SuppleResult suppleGetPatches(SuppleContext handle, SuppleGroup group, uint32_t surface, SupplePatchInfo* out,
                              uint32_t* count) {
    return withSurface(handle, group, surface, "suppleGetPatches",
                       [&](Context& context, Group&, const Tessellation& found) {
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
