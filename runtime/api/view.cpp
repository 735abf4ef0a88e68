// supple_view.h.
#include "runtime/api/entry.h"
#include "runtime/vertex_streams.h"

#include <bit>

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

SuppleResult suppleCreateView(SuppleContext handle, const SuppleViewDesc* given, SuppleView* out) {
    constexpr const char* kHere = "suppleCreateView";
    return onDevice(handle, kHere, [&](Context& context) {
        if (out == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "out is null");
        }
        out->id = 0;
        SuppleViewDesc desc{};
        if (const auto fault = takeIn(context, kHere, "desc", given, desc)) {
            return *fault;
        }
        constexpr uint32_t kFlags = runtime::streamFlags(&runtime::StreamRow::viewFlag) | SUPPLE_VIEW_CULL |
                                    SUPPLE_VIEW_OCCLUSION | SUPPLE_VIEW_BACK_FACES;
        if ((desc.flags & ~kFlags) != 0 || !within(desc.vertexFormat, SUPPLE_VERTEX_24)) {
            return refuse(context, ErrorCode::range, kHere, "unknown flags, or no such vertexFormat");
        }
        if ((desc.flags & (SUPPLE_VIEW_UVS1 | SUPPLE_VIEW_FACE_UVS | SUPPLE_VIEW_TANGENTS)) != 0 &&
            (desc.flags & SUPPLE_VIEW_ATTRIBUTES) == 0) {
            return refuse(context, ErrorCode::argument, kHere, "UVS1, FACE_UVS and TANGENTS go with ATTRIBUTES");
        }
        if ((desc.flags & SUPPLE_VIEW_OCCLUSION) != 0 && (desc.flags & SUPPLE_VIEW_CULL) == 0) {
            return refuse(context, ErrorCode::argument, kHere, "OCCLUSION goes with CULL");
        }
        if (desc.maxVertices < 1024) {
            return refuse(context, ErrorCode::range, kHere, "maxVertices is below 1024");
        }
        if (desc.maxRuns > SUPPLE_MAX_VIEW_RUNS) {
            return refuse(context, ErrorCode::range, kHere, "maxRuns is above SUPPLE_MAX_VIEW_RUNS");
        }
        if (desc.coefficientBytes > 0 && desc.coefficientBytes < runtime::kPoolUnitBytes) {
            return refuse(context, ErrorCode::range, kHere, "coefficientBytes is below 256");
        }
        if (!std::all_of(std::begin(desc.elasticities), std::end(desc.elasticities),
                         [](float e) { return e >= 0.0f && e <= 1.0f; })) {
            return refuse(context, ErrorCode::range, kHere, "an elasticity leaves 0..1");
        }
        Result<uint64_t> id = context.createView(desc);
        if (!id) {
            return report(context, id.error());
        }
        out->id = *id;
        return noted(context, calls::CreateView{*out, desc});
    });
}

SuppleResult suppleDestroyView(SuppleContext handle, SuppleView view) {
    return guarded(handle, "suppleDestroyView", [&](Context& context) {
        return context.destroyView(view.id)
                   ? noted(context, calls::DestroyView{view})
                   : refuse(context, ErrorCode::staleHandle, "suppleDestroyView", "stale or foreign view handle");
    });
}

SuppleResult suppleSetPriority(SuppleContext handle, SuppleInstance instance, uint32_t priority) {
    constexpr const char* kHere = "suppleSetPriority";
    return withInstance(handle, instance, kHere, [&](Context& context, Group& found) {
        if (found.view() == nullptr) {
            return refuse(context, found, ErrorCode::argument, kHere, "the group belongs to no view");
        }
        if (priority >= SUPPLE_PRIORITY_COUNT) {
            return refuse(context, found, ErrorCode::range, kHere,
                          "priority " + std::to_string(priority) + " of " + std::to_string(SUPPLE_PRIORITY_COUNT));
        }
        found.slots().setPriority(instance.slot, priority);
        return noted(context, calls::SetPriority{instance, priority});
    });
}

SuppleResult suppleSetCamera(SuppleContext handle, SuppleView view, const SuppleCameraDesc* given) {
    constexpr const char* kHere = "suppleSetCamera";
    return withView(handle, view, kHere, [&](Context& context, View& found) {
        SuppleCameraDesc camera{};
        if (const auto fault = takeIn(context, kHere, "camera", given, camera)) {
            return *fault;
        }
        if ((camera.flags & ~uint32_t{SUPPLE_CAMERA_ORTHOGRAPHIC}) != 0) {
            return refuse(context, ErrorCode::range, kHere, "unknown flags");
        }
        const float values[] = {camera.position[0], camera.position[1],   camera.position[2],  camera.pixelsPerUnit,
                                camera.nearest,     camera.chordError,    camera.smallestEdge, camera.edgeLength,
                                camera.farthest,    camera.smallestRadius};
        if (!finite(values, std::size(values)) || !finite(camera.viewProjection, 16) || !finite(camera.direction, 3)) {
            return refuse(context, ErrorCode::notFinite, kHere, "the camera is not finite");
        }
        if (camera.pixelsPerUnit <= 0.0f ||
            std::any_of(std::begin(values) + 4, std::end(values), [](float x) { return x < 0.0f; })) {
            return refuse(context, ErrorCode::range, kHere,
                          "pixelsPerUnit must be positive; all other lengths not negative");
        }
        const bool needsDirection =
            (camera.flags & SUPPLE_CAMERA_ORTHOGRAPHIC) != 0 && (found.desc().flags & SUPPLE_VIEW_BACK_FACES) != 0;
        if (needsDirection &&
            std::all_of(std::begin(camera.direction), std::end(camera.direction), [](float x) { return x == 0.0f; })) {
            return refuse(context, ErrorCode::range, kHere,
                          "the view has BACK_FACES and the camera is orthographic: direction is zero");
        }
        found.setCamera(camera);
        return noted(context, calls::SetCamera{view, camera});
    });
}

SuppleResult suppleSetDepthPyramid(SuppleContext handle, SuppleView view, const SuppleDepthPyramidDesc* given) {
    constexpr const char* kHere = "suppleSetDepthPyramid";
    return withView(handle, view, kHere, [&](Context& context, View& found) {
        if ((found.desc().flags & SUPPLE_VIEW_OCCLUSION) == 0) {
            return refuse(context, ErrorCode::argument, kHere, "the view was created without SUPPLE_VIEW_OCCLUSION");
        }
        if (given == nullptr) {
            found.setDepthPyramid(std::nullopt);
            return noted(context, calls::SetDepthPyramid{view, 0});
        }
        SuppleDepthPyramidDesc pyramid{};
        if (const auto fault = takeIn(context, kHere, "pyramid", given, pyramid)) {
            return *fault;
        }
        if ((pyramid.flags & ~uint32_t{SUPPLE_DEPTH_REVERSED}) != 0) {
            return refuse(context, ErrorCode::range, kHere, "unknown flags");
        }
        if (pyramid.imageView == VK_NULL_HANDLE) {
            return refuse(context, ErrorCode::nullPointer, kHere, "imageView is null");
        }
        if (pyramid.layout != VK_IMAGE_LAYOUT_GENERAL && pyramid.layout != VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL &&
            pyramid.layout != VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) {
            return refuse(context, ErrorCode::range, kHere,
                          "layout is not GENERAL, SHADER_READ_ONLY_OPTIMAL or READ_ONLY_OPTIMAL");
        }
        const uint32_t side = std::max(pyramid.width, pyramid.height), limit = context.maxImageSide();
        if (pyramid.width == 0 || pyramid.height == 0 || side > limit) {
            return refuse(context, ErrorCode::range, kHere,
                          "width and height must be 1.." + std::to_string(limit) + ", as the device's images");
        }
        const auto most = static_cast<uint32_t>(std::bit_width(side));
        if (pyramid.mipLevels == 0 || pyramid.mipLevels > most) {
            return refuse(context, ErrorCode::range, kHere,
                          "mipLevels must be 1.." + std::to_string(most) + " for " + std::to_string(pyramid.width) +
                              " x " + std::to_string(pyramid.height));
        }
        if (!finite(pyramid.viewProjection, 16)) {
            return refuse(context, ErrorCode::notFinite, kHere, "viewProjection is not finite");
        }
        found.setDepthPyramid(pyramid);
        return noted(context, calls::SetDepthPyramid{view, 1});
    });
}

SuppleResult suppleGetLevelOutput(SuppleContext handle, SuppleGroup group, uint32_t surface, SuppleLevelOutput* out) {
    constexpr const char* kHere = "suppleGetLevelOutput";
    return withSurface(handle, group, surface, kHere, [&](Context& context, Group& group, const Tessellation& found) {
        if (found.kind() != SUPPLE_TESSELLATION_LEVELS) {
            return refuse(context, group, ErrorCode::argument, kHere, "the surface has no levels");
        }
        group.noteOutputsAsked();
        return describe(context, kHere, out, [&](SuppleLevelOutput& output) { found.fillLevels(output); });
    });
}

SuppleResult suppleGetInstanceBounds(SuppleContext handle, SuppleGroup group, SuppleBufferRange* out) {
    constexpr const char* kHere = "suppleGetInstanceBounds";
    return withGroup(handle, group, kHere, [&](Context& context, Group& found) {
        if (out == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "out is null");
        }
        if (!found.hasBounds()) {
            return refuse(context, found, ErrorCode::argument, kHere,
                          "the group belongs to no view and was created without SUPPLE_GROUP_BOUNDS");
        }
        *out = found.bounds();
        return SUPPLE_OK;
    });
}

SuppleResult suppleReadInstanceBounds(SuppleContext handle, SuppleInstance instance, SuppleBounds* out,
                                      uint64_t* frame) {
    constexpr const char* kHere = "suppleReadInstanceBounds";
    return withInstance(handle, instance, kHere, [&](Context& context, Group& found) {
        if (out == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "out is null");
        }
        if (found.boundsReadback() == nullptr) {
            return refuse(context, found, ErrorCode::argument, kHere,
                          "the group was created without SUPPLE_GROUP_BOUNDS");
        }
        const auto box = found.boundsReadback()->read(instance.slot, instance.generation);
        if (!box) {
            return SUPPLE_NOT_READY;
        }
        *out = box->bounds;
        if (frame != nullptr) {
            *frame = box->frame;
        }
        return SUPPLE_OK;
    });
}

SuppleResult suppleGetViewStatistics(SuppleContext handle, SuppleView view, SuppleViewStatistics* out) {
    constexpr const char* kHere = "suppleGetViewStatistics";
    return withView(handle, view, kHere, [&](Context& context, View& found) {
        if (const auto fault = checkOut(context, kHere, out)) {
            return *fault;
        }
        SuppleViewStatistics statistics = found.statistics();
        statistics.structSize = sizeof(statistics);
        runtime::writeSized(statistics, *out);
        return statistics.frame > 0 ? SUPPLE_OK : SUPPLE_NOT_READY;
    });
}
