// Whether what an instance plays may go straight over a span of time, and by how much it is then off.
#pragma once

#include "runtime/asset.h"
#include "runtime/update_rates.h"
#include "skinning/playback.h"

#include <cstdint>

namespace supple::runtime {

/// `updateInterval`: as UpdateCourse::asked.
[[nodiscard]] UpdateCourse updateCourseOf(const Asset& asset, const skinning::PlaybackDesc& desc,
                                          uint32_t updateInterval);

/// What is played jumps or turns at once within the span: at seams, where clips begin and end, while weights fade.
[[nodiscard]] bool hasCorner(const Asset& asset, const skinning::PlaybackState& state, const PoseSpan& span);

} // namespace supple::runtime
