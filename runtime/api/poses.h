// Which functions go with which source of poses.
#pragma once

#include "runtime/api/entry.h"

namespace supple::api {

/// Whether the group's poses come from `source`, or from `other`.
inline std::optional<SuppleResult> checkSource(Context& context, const char* function, const Group& group,
                                               SupplePoseSource source, SupplePoseSource other) {
    if (group.follows()) {
        return refuse(context, ErrorCode::argument, function, "the group draws the instances of another one");
    }
    const SupplePoseSource own = group.instances().source();
    if (own == source || own == other) {
        return std::nullopt;
    }
    const char* reason = own == SUPPLE_POSES_SET        ? "the group was created without SUPPLE_POSES_PLAYBACK"
                         : own == SUPPLE_POSES_PLAYBACK ? "the group plays its clips on the device: suppleSetPlayback"
                                                        : "the group takes its poses from a buffer that the host fills";
    return refuse(context, group, ErrorCode::argument, function, reason);
}

template <class Body>
SuppleResult withPoses(SuppleContext handle, SuppleInstance instance, const char* function, SupplePoseSource source,
                       SupplePoseSource other, Body&& body) noexcept {
    return withInstance(handle, instance, function, [&](Context& context, Group& found) {
        if (const auto fault = checkSource(context, function, found, source, other)) {
            return *fault;
        }
        return body(context, found);
    });
}
/// For what sets the pose of an instance.
template <class Body>
SuppleResult withPose(SuppleContext handle, SuppleInstance instance, const char* function, Body&& body) noexcept {
    return withPoses(handle, instance, function, SUPPLE_POSES_SET, SUPPLE_POSES_SET, body);
}
/// For what goes with a pose, whether it is set or played.
template <class Body>
SuppleResult withAnyPose(SuppleContext handle, SuppleInstance instance, const char* function, Body&& body) noexcept {
    return withPoses(handle, instance, function, SUPPLE_POSES_SET, SUPPLE_POSES_PLAYBACK, body);
}
/// For what belongs to a group that plays on the device.
template <class Body>
SuppleResult withPlayback(SuppleContext handle, SuppleGroup group, const char* function, Body&& body) noexcept {
    return withGroup(handle, group, function, [&](Context& context, Group& found) {
        if (const auto fault = checkSource(context, function, found, SUPPLE_POSES_PLAYBACK, SUPPLE_POSES_PLAYBACK)) {
            return *fault;
        }
        return body(context, found);
    });
}

} // namespace supple::api
