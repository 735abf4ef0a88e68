// supple.h, pose.
#include "runtime/api/poses.h"
#include "runtime/pose_desc.h"

#include <cstring>
#include <glm/gtc/type_ptr.hpp>

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

SuppleResult suppleSetClipPose(SuppleContext handle, SuppleInstance instance, uint32_t clip, double time) {
    constexpr const char* kHere = "suppleSetClipPose";
    return withPose(handle, instance, kHere, [&](Context& context, Group& found) {
        if (clip == SUPPLE_BIND_POSE) {
            found.poses().host()->setBindPose(instance.slot);
            return noted(context, calls::SetClipPose{instance, clip, 0.0});
        }
        if (clip == SUPPLE_REST_POSE) {
            found.poses().host()->setRestPose(instance.slot);
            return noted(context, calls::SetClipPose{instance, clip, 0.0});
        }
        const size_t clips = found.asset().character.clips.size();
        if (clip >= clips) {
            return refuse(context, found, ErrorCode::range, kHere,
                          "clip " + std::to_string(clip) + " of " + std::to_string(clips));
        }
        if (!std::isfinite(time)) {
            return refuse(context, found, ErrorCode::notFinite, kHere, "time is not finite");
        }
        found.poses().host()->setClipPose(instance.slot, clip, time);
        return noted(context, calls::SetClipPose{instance, clip, time});
    });
}

SuppleResult suppleSetMorphWeights(SuppleContext handle, SuppleInstance instance, const float* weights,
                                   uint32_t morphTargetCount) {
    constexpr const char* kHere = "suppleSetMorphWeights";
    return withAnyPose(handle, instance, kHere, [&](Context& context, Group& found) {
        if (weights != nullptr) {
            const size_t targets = found.asset().character.morphs.targets.size();
            if (morphTargetCount != targets) {
                return refuse(context, found, ErrorCode::range, kHere,
                              "morphTargetCount " + std::to_string(morphTargetCount) + ": the asset has " +
                                  std::to_string(targets));
            }
            if (!finite(weights, morphTargetCount)) {
                return refuse(context, found, ErrorCode::notFinite, kHere, "a weight is not finite");
            }
        }
        found.poses().setMorphWeights(instance.slot, weights);
        return noted(context, calls::SetMorphWeights{instance, weights, morphTargetCount});
    });
}

SuppleResult suppleSetMatrixPose(SuppleContext handle, SuppleInstance instance, const float* jointMatrices,
                                 uint32_t jointCount) {
    constexpr const char* kHere = "suppleSetMatrixPose";
    return withPose(handle, instance, kHere, [&](Context& context, Group& found) {
        if (jointMatrices == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "jointMatrices is null");
        }
        const size_t joints = found.asset().character.skin.joints.size();
        if (jointCount != joints) {
            return refuse(context, found, ErrorCode::range, kHere,
                          "jointCount " + std::to_string(jointCount) + ": the skin has " + std::to_string(joints));
        }
        if (!finite(jointMatrices, 16 * size_t{jointCount})) {
            return refuse(context, found, ErrorCode::notFinite, kHere, "a joint matrix is not finite");
        }
        found.poses().host()->setMatrixPose(instance.slot, jointMatrices);
        return noted(context, calls::SetMatrixPose{instance, jointMatrices, 16 * jointCount});
    });
}

SuppleResult suppleSetJointMatrices(SuppleContext handle, SuppleInstance instance,
                                    const SuppleJointMatricesDesc* given) {
    constexpr const char* kHere = "suppleSetJointMatrices";
    return withPose(handle, instance, kHere, [&](Context& context, Group& found) {
        SuppleJointMatricesDesc desc{};
        if (const auto fault = takeIn(context, kHere, "matrices", given, desc)) {
            return *fault;
        }
        const Status valid = runtime::checkJointMatrices(found.asset(), desc);
        if (!valid) {
            return refuse(context, found, valid.error().code, kHere, valid.error().message);
        }
        found.poses().host()->setJointMatrices(instance.slot, desc);
        return noted(context, calls::SetJointMatrices{instance, desc});
    });
}

SuppleResult suppleGetJointTransform(SuppleContext handle, SuppleInstance instance, uint32_t joint, float* out) {
    constexpr const char* kHere = "suppleGetJointTransform";
    return withAnyPose(handle, instance, kHere, [&](Context& context, Group& found) {
        if (out == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "out is null");
        }
        const size_t joints = found.asset().character.skin.joints.size();
        if (joint >= joints) {
            return refuse(context, found, ErrorCode::range, kHere,
                          "joint " + std::to_string(joint) + " of " + std::to_string(joints));
        }
        found.poses().setOrigin(context.origin(), found.slots().end());
        const glm::mat4 transform = found.poses().jointTransform(instance.slot, joint);
        std::memcpy(out, glm::value_ptr(transform), sizeof(transform));
        return SUPPLE_OK;
    });
}

SuppleResult suppleSetPosition(SuppleContext handle, SuppleInstance instance, const double* position) {
    constexpr const char* kHere = "suppleSetPosition";
    return withAnyPose(handle, instance, kHere, [&](Context& context, Group& found) {
        if (position == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "position is null");
        }
        if (!finite(position, 3)) {
            return refuse(context, ErrorCode::notFinite, kHere, "position is not finite");
        }
        found.poses().setPosition(instance.slot, {position[0], position[1], position[2]});
        return noted(context, calls::SetPosition{instance, {position[0], position[1], position[2]}});
    });
}

SuppleResult suppleSetTransform(SuppleContext handle, SuppleInstance instance, const float* transform) {
    constexpr const char* kHere = "suppleSetTransform";
    return withAnyPose(handle, instance, kHere, [&](Context& context, Group& found) {
        if (transform == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "transform is null");
        }
        if (!finite(transform, 16)) {
            return refuse(context, found, ErrorCode::notFinite, kHere, "transform is not finite");
        }
        if (transform[3] != 0.0f || transform[7] != 0.0f || transform[11] != 0.0f || transform[15] != 1.0f) {
            return refuse(context, found, ErrorCode::range, kHere, "the last row is not 0, 0, 0, 1");
        }
        found.poses().setTransform(instance.slot, glm::make_mat4(transform));
        calls::SetTransform call{instance};
        std::copy_n(transform, 16, call.transform);
        return noted(context, call);
    });
}
