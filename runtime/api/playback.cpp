// supple_playback.h.
#include "runtime/api/poses.h"
#include "runtime/playback_desc.h"
#include "runtime/pose_desc.h"

#include <cstring>
#include <glm/gtc/type_ptr.hpp>

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

SuppleResult suppleFillJointMask(SuppleContext handle, SuppleAsset asset, uint32_t joint, float value, float* mask,
                                 uint32_t jointCount) {
    constexpr const char* kHere = "suppleFillJointMask";
    return withAsset(handle, asset, kHere, [&](Context& context, const Asset& found) {
        if (mask == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "mask is null");
        }
        const size_t joints = found.character.skin.joints.size();
        if (jointCount != joints || joint >= jointCount) {
            return refuse(context, ErrorCode::range, kHere,
                          "joint " + std::to_string(joint) + ", jointCount " + std::to_string(jointCount) +
                              ": the skin has " + std::to_string(joints));
        }
        if (!(value >= 0.0f && value <= 1.0f)) {
            return refuse(context, ErrorCode::range, kHere, "value leaves 0..1");
        }
        skinning::fillJointMask(found.rig, joint, value, {mask, jointCount});
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetPose(SuppleContext handle, SuppleInstance instance, const SupplePoseDesc* given) {
    constexpr const char* kHere = "suppleSetPose";
    return withPose(handle, instance, kHere, [&](Context& context, Group& found) {
        SupplePoseDesc pose{};
        if (const auto fault = takeIn(context, kHere, "pose", given, pose)) {
            return *fault;
        }
        const Status valid = runtime::checkPose(found.asset(), pose);
        if (!valid) {
            return refuse(context, found, valid.error().code, kHere, valid.error().message);
        }
        found.poses().host()->setLayers(instance.slot, pose);
        return noted(context, calls::SetPose{instance, pose});
    });
}

SuppleResult suppleGetRootMotion(SuppleContext handle, SuppleAsset asset, const SupplePoseDesc* given,
                                 SuppleRootMotion* out) {
    constexpr const char* kHere = "suppleGetRootMotion";
    return withAsset(handle, asset, kHere, [&](Context& context, const Asset& found) {
        if (const auto fault = checkOut(context, kHere, out)) {
            return *fault;
        }
        SupplePoseDesc pose{};
        if (const auto fault = takeIn(context, kHere, "pose", given, pose)) {
            return *fault;
        }
        const Status valid = runtime::checkPose(found, pose);
        if (!valid) {
            return refuse(context, valid.error().code, kHere, valid.error().message);
        }
        const skinning::RootMotion motion = runtime::rootMotionOf(found, pose);
        const glm::mat4 transform(skinning::toMatrix(motion));
        SuppleRootMotion filled{};
        for (int axis = 0; axis < 3; ++axis) {
            filled.translation[axis] = transform[3][axis];
        }
        filled.yaw = static_cast<float>(motion.yaw);
        std::memcpy(filled.transform, glm::value_ptr(transform), sizeof(filled.transform));
        runtime::writeSized(filled, *out);
        return SUPPLE_OK;
    });
}

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
                             return refuse(context, found, valid.error().code, kHere, valid.error().message);
                         }
                         runtime::PlaybackLayers layers;
                         found.poses().playback()->set(instance.slot, runtime::playbackOf(found.asset(), desc, layers),
                                                       runtime::transitionRequestOf(desc), desc.updateInterval);
                         return noted(context, calls::SetPlayback{instance, desc});
                     });
}

SuppleResult suppleSetTime(SuppleContext handle, SuppleGroup group, double seconds) {
    constexpr const char* kHere = "suppleSetTime";
    return withPlayback(handle, group, kHere, [&](Context& context, Group& found) {
        const Status valid = runtime::checkTime(seconds);
        if (!valid) {
            return refuse(context, found, valid.error().code, kHere, valid.error().message);
        }
        found.poses().playback()->setTime(seconds);
        return noted(context, calls::SetTime{group, seconds});
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
            return refuse(context, found, valid.error().code, kHere, valid.error().message);
        }
        found.poses().playback()->setMask(desc.mask, {desc.jointMask, desc.jointMaskCount},
                                          {desc.morphMask, desc.morphMaskCount});
        return noted(context, calls::SetMask{group, desc});
    });
}
