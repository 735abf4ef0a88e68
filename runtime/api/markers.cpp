// supple_playback.h, markers and contacts.
#include "runtime/api/entry.h"
#include "skinning/clip_markers.h"
#include "skinning/contacts.h"

#include <algorithm>
#include <limits>
#include <vector>

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

namespace {

/// `body(context, asset, clip)`, with a clip that the asset has, if there is a count to fill.
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
        return body(context, found, clips[clip]);
    });
}

/// By rising begin; what lies beyond the clip is cut off.
std::vector<SuppleClipContact> contactsOf(const Asset& asset, uint32_t clip, double duration) {
    const cage::Character& character = asset.character;
    if (!asset.contacts) {
        asset.contacts = skinning::findContacts(character);
    }
    std::vector<SuppleClipContact> list;
    for (size_t f = 0; f < asset.contacts->feet.size(); ++f) {
        const skinning::Foot& foot = asset.contacts->feet[f];
        const std::vector<uint32_t>& joints = character.skin.joints;
        const auto joint = std::find(joints.begin(), joints.end(), foot.node) - joints.begin();
        for (const skinning::Contact& contact : asset.contacts->of(clip, f)) {
            const double begin = std::max(contact.begin, 0.0), end = std::min(contact.end, duration);
            if (begin < end) {
                const glm::dvec2 place = contact.place + contact.drift * begin;
                list.push_back(
                    {static_cast<uint32_t>(joint),
                     begin,
                     end,
                     {static_cast<float>(place.x), static_cast<float>(foot.sole), static_cast<float>(place.y)},
                     {static_cast<float>(contact.drift.x), 0.0f, static_cast<float>(contact.drift.y)}});
            }
        }
    }
    std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
    return list;
}

} // namespace

SuppleResult suppleGetClipMarkers(SuppleContext handle, SuppleAsset asset, uint32_t clip, SuppleClipMarker* out,
                                  uint32_t* count) {
    return withMarkers(handle, asset, "suppleGetClipMarkers", clip, count,
                       [&](Context&, const Asset&, const cage::Clip& found) {
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
    return withMarkers(handle, asset, kHere, clip, count, [&](Context& context, const Asset&, const cage::Clip& found) {
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

SuppleResult suppleGetClipContacts(SuppleContext handle, SuppleAsset asset, uint32_t clip, SuppleClipContact* out,
                                   uint32_t* count) {
    constexpr const char* kHere = "suppleGetClipContacts";
    return withMarkers(handle, asset, kHere, clip, count, [&](Context&, const Asset& found, const cage::Clip& own) {
        const std::vector<SuppleClipContact> contacts = contactsOf(found, clip, own.duration);
        const auto total = static_cast<uint32_t>(contacts.size());
        const uint32_t n = out == nullptr ? 0 : std::min(*count, total);
        std::copy_n(contacts.begin(), n, out);
        *count = total;
        return out != nullptr && n < total ? SUPPLE_INCOMPLETE : SUPPLE_OK;
    });
}
