#include "runtime/playback_desc.h"

#include "runtime/pose_desc.h"
#include "runtime/sized.h"

#include <cmath>
#include <string>

namespace supple::runtime {

namespace {

static_assert(SUPPLE_MAX_PLAYBACK_LAYERS == shared::kMaxPlaybackLayers);
static_assert(SUPPLE_MAX_MASKS == shared::kMaxMasks);

constexpr float kMaxSpeed = 1000.0f;

Error outside(const std::string& reason) {
    return {ErrorCode::range, reason};
}

Status checkLayer(const cage::Character& character, const Playback& playback, const SupplePlaybackLayer& layer) {
    if (layer.clip >= character.clips.size()) {
        return outside("no such clip");
    }
    if (rawValue(layer.mode) > SUPPLE_LAYER_ADDITIVE) {
        return outside("no such mode");
    }
    if ((layer.flags & ~uint32_t{SUPPLE_LAYER_LOOP}) != 0) {
        return outside("unknown flags");
    }
    if (layer.mask > SUPPLE_MAX_MASKS || (layer.mask != 0 && !playback.hasMask(layer.mask))) {
        return outside("no such mask");
    }
    if (!std::isfinite(layer.weight) || !std::isfinite(layer.fadeWeight)) {
        return Error{ErrorCode::notFinite, "a weight is not finite"};
    }
    const auto inside = [](float weight) { return weight >= 0.0f && weight <= 1.0f; };
    if (layer.mode == SUPPLE_LAYER_BLEND && (!inside(layer.weight) || !inside(layer.fadeWeight))) {
        return outside("a weight leaves 0..1");
    }
    if (!std::isfinite(layer.speed) || !std::isfinite(layer.fadeDuration)) {
        return Error{ErrorCode::notFinite, "speed or fadeDuration is not finite"};
    }
    if (std::abs(layer.speed) > kMaxSpeed || layer.fadeDuration < 0.0f) {
        return outside("speed or fadeDuration is out of range");
    }
    for (const double time : {layer.startTime, layer.offset, layer.fadeStart, layer.referenceTime}) {
        Status valid = checkTime(time);
        if (!valid) {
            return valid;
        }
    }
    return success();
}

Status checkTransition(const Playback& playback, const SupplePlaybackDesc& desc) {
    if (rawValue(desc.transitionKind) > SUPPLE_TRANSITION_QUINTIC) {
        return outside("no such kind of transition");
    }
    if (!std::isfinite(desc.transition)) {
        return Error{ErrorCode::notFinite, "transition is not finite"};
    }
    if (desc.transition < 0.0 || desc.transition > SUPPLE_MAX_TIME) {
        return outside("transition is out of range");
    }
    const bool transits = desc.transition > 0.0;
    if (transits && !playback.takesTransitions()) {
        return Error{ErrorCode::argument, "a transition in a group without SUPPLE_GROUP_TRANSITIONS"};
    }
    if (transits && (desc.flags & SUPPLE_PLAYBACK_KEEP_TRANSITION) != 0) {
        return Error{ErrorCode::argument, "a transition with SUPPLE_PLAYBACK_KEEP_TRANSITION"};
    }
    if (!transits && (desc.flags & SUPPLE_PLAYBACK_FROM_MODIFIED) != 0) {
        return Error{ErrorCode::argument, "SUPPLE_PLAYBACK_FROM_MODIFIED without a transition"};
    }
    return success();
}

Status checkUpdateInterval(const Playback& playback, uint32_t interval) {
    if (interval > shared::kMaxUpdateInterval || (interval & (interval - 1)) != 0) {
        return outside("updateInterval is none of 0, 1, 2, 4 and 8");
    }
    if (interval != 0 && !playback.takesUpdateRates()) {
        return Error{ErrorCode::argument, "an updateInterval in a group without SUPPLE_GROUP_UPDATE_RATES"};
    }
    return success();
}

} // namespace

Status checkTime(double seconds) {
    if (!std::isfinite(seconds)) {
        return Error{ErrorCode::notFinite, "a time is not finite"};
    }
    if (std::abs(seconds) > SUPPLE_MAX_TIME) {
        return outside("a time is beyond SUPPLE_MAX_TIME");
    }
    return success();
}

Status checkMask(const Asset& asset, const SuppleMaskDesc& desc) {
    if (desc.mask == 0 || desc.mask > SUPPLE_MAX_MASKS) {
        return outside("masks are numbered from 1 to " + std::to_string(SUPPLE_MAX_MASKS));
    }
    if (desc.jointMask == nullptr && desc.morphMask == nullptr) {
        return Error{ErrorCode::nullPointer, "jointMask and morphMask are null"};
    }
    const cage::Character& character = asset.character;
    if (const char* fault = maskFault(desc.jointMask, desc.jointMaskCount, character.skin.joints.size())) {
        return outside(std::string("jointMask ") + fault);
    }
    if (const char* fault = maskFault(desc.morphMask, desc.morphMaskCount, character.morphs.targets.size())) {
        return outside(std::string("morphMask ") + fault);
    }
    return success();
}

Status checkPlayback(const Asset& asset, const Playback& playback, const SupplePlaybackDesc& desc) {
    constexpr uint32_t kFlags = SUPPLE_PLAYBACK_ROOT_JOINT | SUPPLE_PLAYBACK_TRAVEL | SUPPLE_PLAYBACK_KEEP_TRANSITION |
                                SUPPLE_PLAYBACK_FROM_MODIFIED;
    if (desc.layerCount > 0 && desc.layers == nullptr) {
        return Error{ErrorCode::nullPointer, "layers is null"};
    }
    if (desc.layerCount > SUPPLE_MAX_PLAYBACK_LAYERS) {
        return outside(std::to_string(desc.layerCount) + " layers of at most " +
                       std::to_string(SUPPLE_MAX_PLAYBACK_LAYERS));
    }
    if ((desc.flags & ~kFlags) != 0) {
        return outside("unknown flags");
    }
    const bool named = (desc.flags & SUPPLE_PLAYBACK_ROOT_JOINT) != 0;
    Status valid = checkRoot(asset, desc.rootMotion, named ? &desc.rootJoint : nullptr);
    if (!valid) {
        return valid;
    }
    if ((desc.flags & SUPPLE_PLAYBACK_TRAVEL) != 0 && desc.rootMotion == 0) {
        return Error{ErrorCode::argument, "SUPPLE_PLAYBACK_TRAVEL without rootMotion to travel by"};
    }
    valid = checkTransition(playback, desc);
    valid = valid ? checkUpdateInterval(playback, desc.updateInterval) : valid;
    if (!valid) {
        return valid;
    }
    for (uint32_t i = 0; i < desc.layerCount; ++i) {
        valid = checkLayer(asset.character, playback, desc.layers[i]);
        if (!valid) {
            return Error{valid.error().code, "layer " + std::to_string(i) + ": " + valid.error().message};
        }
    }
    return success();
}

skinning::PlaybackDesc playbackOf(const Asset& asset, const SupplePlaybackDesc& desc, PlaybackLayers& layers) {
    for (uint32_t i = 0; i < desc.layerCount; ++i) {
        const SupplePlaybackLayer& from = desc.layers[i];
        skinning::PlaybackLayer& layer = layers[i];
        layer.clip = from.clip;
        layer.mode = from.mode == SUPPLE_LAYER_ADDITIVE ? skinning::LayerMode::additive : skinning::LayerMode::blend;
        layer.loop = (from.flags & SUPPLE_LAYER_LOOP) != 0;
        layer.mask = from.mask;
        layer.weight = from.weight;
        layer.fadeWeight = from.fadeWeight;
        layer.fadeStart = from.fadeStart;
        layer.fadeDuration = from.fadeDuration;
        layer.start = from.startTime;
        layer.offset = from.offset;
        layer.speed = from.speed;
        layer.referenceTime = from.referenceTime;
    }
    const bool named = (desc.flags & SUPPLE_PLAYBACK_ROOT_JOINT) != 0;
    skinning::PlaybackDesc result;
    result.layers = {layers.data(), desc.layerCount};
    result.root = {named ? asset.character.skin.joints[desc.rootJoint] : asset.rig.root, desc.rootMotion};
    result.travels = (desc.flags & SUPPLE_PLAYBACK_TRAVEL) != 0;
    return result;
}

TransitionRequest transitionRequestOf(const SupplePlaybackDesc& desc) {
    TransitionRequest request;
    request.kind = desc.transitionKind == SUPPLE_TRANSITION_QUINTIC ? skinning::TransitionKind::quintic
                                                                    : skinning::TransitionKind::deadBlending;
    request.seconds = static_cast<float>(desc.transition);
    request.fromModified = (desc.flags & SUPPLE_PLAYBACK_FROM_MODIFIED) != 0;
    request.keeps = (desc.flags & SUPPLE_PLAYBACK_KEEP_TRANSITION) != 0;
    return request;
}

} // namespace supple::runtime
