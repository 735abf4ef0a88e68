// supple_playback.h.
#include "runtime/api/poses.h"
#include "runtime/playback_desc.h"

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

SuppleResult suppleSetPlayback(SuppleContext handle, SuppleInstance instance, const SupplePlaybackDesc* given) {
    constexpr const char* kHere = "suppleSetPlayback";
    return withPoses(handle, instance, kHere, SUPPLE_POSES_PLAYBACK, SUPPLE_POSES_PLAYBACK,
                     [&](Context& context, Group& found) {
                         SupplePlaybackDesc desc{};
                         if (const auto fault = takeIn(context, kHere, "playback", given, desc)) {
                             return *fault;
                         }
                         const Status valid = runtime::checkPlayback(found.asset(), *found.poses().playback(), desc);
                         if (!valid) {
                             return refuse(context, valid.error().code, kHere, valid.error().message);
                         }
                         runtime::PlaybackLayers layers;
                         found.poses().playback()->set(instance.slot, runtime::playbackOf(found.asset(), desc, layers));
                         return SUPPLE_OK;
                     });
}

SuppleResult suppleSetTime(SuppleContext handle, SuppleGroup group, double seconds) {
    constexpr const char* kHere = "suppleSetTime";
    return withPlayback(handle, group, kHere, [&](Context& context, Group& found) {
        const Status valid = runtime::checkTime(seconds);
        if (!valid) {
            return refuse(context, valid.error().code, kHere, valid.error().message);
        }
        found.poses().playback()->setTime(seconds);
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetMask(SuppleContext handle, SuppleGroup group, const SuppleMaskDesc* given) {
    constexpr const char* kHere = "suppleSetMask";
    return withPlayback(handle, group, kHere, [&](Context& context, Group& found) {
        SuppleMaskDesc desc{};
        if (const auto fault = takeIn(context, kHere, "mask", given, desc)) {
            return *fault;
        }
        const Status valid = runtime::checkMask(found.asset(), desc);
        if (!valid) {
            return refuse(context, valid.error().code, kHere, valid.error().message);
        }
        found.poses().playback()->setMask(desc.mask, {desc.jointMask, desc.jointMaskCount},
                                          {desc.morphMask, desc.morphMaskCount});
        return SUPPLE_OK;
    });
}
