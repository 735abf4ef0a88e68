#include "runtime/pose_desc.h"

#include "runtime/sized.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace supple::runtime {

namespace {

static_assert(uint32_t{SUPPLE_ROOT_MOTION_GROUND} == uint32_t{skinning::kRootGround});
static_assert(uint32_t{SUPPLE_ROOT_MOTION_HEIGHT} == uint32_t{skinning::kRootHeight});
static_assert(uint32_t{SUPPLE_ROOT_MOTION_YAW} == uint32_t{skinning::kRootYaw});
constexpr uint32_t kRootFlags = SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_HEIGHT | SUPPLE_ROOT_MOTION_YAW;

Status checkLayer(const cage::Character& character, const SuppleClipLayer& layer) {
    const auto outside = [](const std::string& reason) { return Error{ErrorCode::range, reason}; };
    if (layer.clip >= character.clips.size()) {
        return outside("no such clip");
    }
    if (rawValue(layer.mode) > SUPPLE_LAYER_ADDITIVE) {
        return outside("no such mode");
    }
    if ((layer.flags & ~uint32_t{SUPPLE_LAYER_LOOP}) != 0) {
        return outside("unknown flags");
    }
    if (!std::isfinite(layer.time) || !std::isfinite(layer.previousTime) || !std::isfinite(layer.referenceTime)) {
        return Error{ErrorCode::notFinite, "a time is not finite"};
    }
    if (!std::isfinite(layer.weight)) {
        return Error{ErrorCode::notFinite, "weight is not finite"};
    }
    if (layer.mode == SUPPLE_LAYER_BLEND && (layer.weight < 0.0f || layer.weight > 1.0f)) {
        return outside("weight leaves 0..1");
    }
    if (const char* fault = maskFault(layer.jointMask, layer.jointMaskCount, character.skin.joints.size())) {
        return outside(std::string("jointMask ") + fault);
    }
    if (const char* fault = maskFault(layer.morphMask, layer.morphMaskCount, character.morphs.targets.size())) {
        return outside(std::string("morphMask ") + fault);
    }
    return success();
}

} // namespace

const char* maskFault(const float* mask, uint32_t count, size_t wanted) {
    if (mask == nullptr) {
        return count == 0 ? nullptr : "is null, but its count is not 0";
    }
    if (count != wanted) {
        return "has not one value for each";
    }
    const bool inside = std::all_of(mask, mask + count, [](float x) { return x >= 0.0f && x <= 1.0f; });
    return inside ? nullptr : "leaves 0..1";
}

Status checkRoot(const Asset& asset, uint32_t rootMotion, const uint32_t* rootJoint) {
    const cage::Character& character = asset.character;
    const auto refuse = [](const std::string& reason) { return Error{ErrorCode::range, reason}; };
    if ((rootMotion & ~kRootFlags) != 0) {
        return refuse("unknown flags");
    }
    if (rootJoint != nullptr) {
        if (*rootJoint >= character.skin.joints.size()) {
            return refuse("rootJoint: no such joint");
        }
        if (character.skeleton.nodes[character.skin.joints[*rootJoint]].hasMatrix) {
            return refuse("rootJoint has a fixed matrix");
        }
    }
    return success();
}

Status checkPose(const Asset& asset, const SupplePoseDesc& desc) {
    const cage::Character& character = asset.character;
    const auto refuse = [](const std::string& reason) { return Error{ErrorCode::range, reason}; };
    if (desc.layerCount > 0 && desc.layers == nullptr) {
        return Error{ErrorCode::nullPointer, "layers is null"};
    }
    if ((desc.flags & ~uint32_t{SUPPLE_POSE_ROOT_JOINT}) != 0) {
        return refuse("unknown flags");
    }
    const bool named = (desc.flags & SUPPLE_POSE_ROOT_JOINT) != 0;
    Status root = checkRoot(asset, desc.rootMotion, named ? &desc.rootJoint : nullptr);
    if (!root) {
        return root;
    }
    for (uint32_t i = 0; i < desc.layerCount; ++i) {
        const Status valid = checkLayer(character, desc.layers[i]);
        if (!valid) {
            return Error{valid.error().code, "layer " + std::to_string(i) + ": " + valid.error().message};
        }
    }
    return success();
}

Status checkJointMatrices(const Asset& asset, const SuppleJointMatricesDesc& desc) {
    const size_t joints = asset.character.skin.joints.size(), targets = asset.character.morphs.targets.size();
    if (desc.jointMatrices == nullptr && desc.jointCount > 0) {
        return Error{ErrorCode::nullPointer, "jointMatrices is null"};
    }
    if (desc.joints == nullptr ? desc.jointCount != joints : desc.jointCount > joints) {
        return Error{ErrorCode::range,
                     "jointCount " + std::to_string(desc.jointCount) + ": the skin has " + std::to_string(joints)};
    }
    const auto isFinite = [](float x) { return std::isfinite(x); };
    if (!std::all_of(desc.jointMatrices, desc.jointMatrices + 16 * size_t{desc.jointCount}, isFinite)) {
        return Error{ErrorCode::notFinite, "a joint matrix is not finite"};
    }
    std::vector<bool> named(desc.joints != nullptr ? joints : 0, false);
    for (uint32_t k = 0; desc.joints != nullptr && k < desc.jointCount; ++k) {
        if (desc.joints[k] >= joints || named[desc.joints[k]]) {
            return Error{ErrorCode::range, "joint " + std::to_string(desc.joints[k]) +
                                               (desc.joints[k] >= joints ? ": no such joint" : " comes twice")};
        }
        named[desc.joints[k]] = true;
    }
    if (desc.morphTargetCount != (desc.morphWeights != nullptr ? targets : 0)) {
        return Error{ErrorCode::range, "morphTargetCount " + std::to_string(desc.morphTargetCount) +
                                           ": the asset has " + std::to_string(targets)};
    }
    if (!std::all_of(desc.morphWeights, desc.morphWeights + desc.morphTargetCount, isFinite)) {
        return Error{ErrorCode::notFinite, "a morph weight is not finite"};
    }
    return success();
}

skinning::Layer layerOf(const Asset& asset, const SuppleClipLayer& layer) {
    skinning::Layer result;
    result.clip = &asset.character.clips[layer.clip];
    result.time = layer.time;
    result.previousTime = layer.previousTime;
    result.referenceTime = layer.referenceTime;
    result.weight = static_cast<double>(layer.weight);
    result.mode = layer.mode == SUPPLE_LAYER_ADDITIVE ? skinning::LayerMode::additive : skinning::LayerMode::blend;
    result.loop = (layer.flags & SUPPLE_LAYER_LOOP) != 0;
    if (layer.jointMask != nullptr) {
        result.jointMask = {layer.jointMask, layer.jointMaskCount};
    }
    if (layer.morphMask != nullptr) {
        result.morphMask = {layer.morphMask, layer.morphMaskCount};
    }
    return result;
}

skinning::RootSelection rootSelection(const Asset& asset, const SupplePoseDesc& desc) {
    const bool named = (desc.flags & SUPPLE_POSE_ROOT_JOINT) != 0;
    return {named ? asset.character.skin.joints[desc.rootJoint] : asset.rig.root, desc.rootMotion};
}

skinning::RootMotion rootMotionOf(const Asset& asset, const SupplePoseDesc& desc) {
    const skinning::RootSelection root = rootSelection(asset, desc);
    skinning::RootMotion motion;
    for (uint32_t i = 0; i < desc.layerCount; ++i) {
        motion = skinning::layerRootMotion(asset.character, asset.rig, layerOf(asset, desc.layers[i]), root, motion);
    }
    return motion;
}

} // namespace supple::runtime
