// SupplePlaybackDesc: checked, and in the words of skinning/.
#pragma once

#include "base/result.h"
#include "runtime/playback.h"
#include "supple/supple.h"

#include <array>
#include <cstdint>

namespace supple::runtime {

/// Success, or the first rule of supple.h that `desc` breaks.
[[nodiscard]] Status checkPlayback(const Asset& asset, const Playback& playback, const SupplePlaybackDesc& desc);

using PlaybackLayers = std::array<skinning::PlaybackLayer, SUPPLE_MAX_PLAYBACK_LAYERS>;
/// Of what checkPlayback takes; `layers` is memory for its layers.
[[nodiscard]] skinning::PlaybackDesc playbackOf(const Asset& asset, const SupplePlaybackDesc& desc,
                                                PlaybackLayers& layers);

/// `desc` is what checkPlayback takes.
[[nodiscard]] TransitionRequest transitionRequestOf(const SupplePlaybackDesc& desc);

/// Of a time that the group can have.
[[nodiscard]] Status checkTime(double seconds);
/// Of a mask's number and values.
[[nodiscard]] Status checkMask(const Asset& asset, const SuppleMaskDesc& desc);

} // namespace supple::runtime
