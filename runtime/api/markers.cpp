// supple_playback.h, markers.
#include "runtime/api/entry.h"
#include "skinning/clip_markers.h"

#include <limits>
#include <vector>

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

namespace {

/// `body(context, clip)`, with a clip that the asset has, if there is a count to fill.
template <class Body>
SuppleResult withMarkers(SuppleContext handle, SuppleAsset asset, const char* function, uint32_t clip,
                         const uint32_t* count, Body&& body) noexcept {
    return withAsset(handle, asset, function, [&](Context& context, const Asset& found) {
        if (count == nullptr) {
            return refuse(context, ErrorCode::nullPointer, function, "count is null");
        }
        const auto& clips = found.character.clips;
        if (clip >= clips.size()) {
            return refuse(context, ErrorCode::range, function,
                          found.character.name + ": clip " + std::to_string(clip) + " of " +
                              std::to_string(clips.size()));
        }
        return body(context, clips[clip]);
    });
}

} // namespace

SuppleResult suppleGetClipMarkers(SuppleContext handle, SuppleAsset asset, uint32_t clip, SuppleClipMarker* out,
                                  uint32_t* count) {
    return withMarkers(handle, asset, "suppleGetClipMarkers", clip, count, [&](Context&, const cage::Clip& found) {
        const auto total = static_cast<uint32_t>(found.markers.size());
        const uint32_t n = out == nullptr ? 0 : std::min(*count, total);
        for (uint32_t m = 0; m < n; ++m) {
            out[m] = {found.markers[m].name.c_str(), found.markers[m].time};
        }
        *count = total;
        return out != nullptr && n < total ? SUPPLE_INCOMPLETE : SUPPLE_OK;
    });
}

SuppleResult suppleGetClipMarkersBetween(SuppleContext handle, SuppleAsset asset, uint32_t clip, double from, double to,
                                         uint32_t flags, SuppleClipMarker* out, uint32_t* count) {
    constexpr const char* kHere = "suppleGetClipMarkersBetween";
    return withMarkers(handle, asset, kHere, clip, count, [&](Context& context, const cage::Clip& found) {
        if ((flags & ~uint32_t{SUPPLE_MARKERS_LOOP | SUPPLE_MARKERS_START}) != 0) {
            return refuse(context, ErrorCode::range, kHere, "unknown flags");
        }
        if (!std::isfinite(from) || !std::isfinite(to)) {
            return refuse(context, ErrorCode::notFinite, kHere, "from or to is not finite");
        }
        if (std::abs(from) > SUPPLE_MAX_TIME || std::abs(to) > SUPPLE_MAX_TIME) {
            return refuse(context, ErrorCode::range, kHere, "from or to is beyond SUPPLE_MAX_TIME");
        }
        const skinning::MarkerInterval interval{from, to, (flags & SUPPLE_MARKERS_LOOP) != 0,
                                                (flags & SUPPLE_MARKERS_START) != 0};
        const uint64_t total = skinning::markersBetween(found, interval, {});
        const uint64_t room = out == nullptr ? 0 : *count;
        std::vector<skinning::PassedMarker> passed(std::min(total, room));
        *count = static_cast<uint32_t>(std::min<uint64_t>(total, std::numeric_limits<uint32_t>::max()));
        if (!passed.empty()) {
            (void)skinning::markersBetween(found, interval, passed);
        }
        for (size_t m = 0; m < passed.size(); ++m) {
            out[m] = {found.markers[passed[m].marker].name.c_str(), passed[m].time};
        }
        return out != nullptr && passed.size() < total ? SUPPLE_INCOMPLETE : SUPPLE_OK;
    });
}
