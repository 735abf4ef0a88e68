#include "runtime/pose_spans.h"

#include "skinning/played_pose.h"

#include <algorithm>
#include <cmath>

namespace supple::runtime {

UpdateCourse updateCourseOf(const Asset& asset, const skinning::PlaybackDesc& desc, uint32_t updateInterval) {
    UpdateCourse course;
    course.asked = updateInterval;
    for (const skinning::PlaybackLayer& layer : desc.layers) { // those that add have no box, and so no size
        if (layer.weight == 0.0f && !(layer.fadeDuration > 0.0f)) {
            continue;
        }
        const skinning::UpdateErrors& errors = asset.updates.ofClips[layer.clip];
        const double speed = std::abs(static_cast<double>(layer.speed));
        for (size_t n = 0; n < UpdateCourse::kIntervals.size(); ++n) {
            const auto own = static_cast<float>(errors.at(speed * UpdateCourse::kIntervals[n]));
            course.errors[n] = std::max(course.errors[n], own);
        }
    }
    return course;
}

bool hasCorner(const Asset& asset, const skinning::PlaybackState& state, const PoseSpan& span) {
    constexpr double kSlack = 1e-5; // as finely as the device tells times apart
    const double first = span.begin - kSlack, last = span.end + kSlack;
    if (state.inBindPose()) {
        return false;
    }
    skinning::PlaybackState::Layers memory;
    const skinning::PlaybackDesc desc = state.read(*asset.clipTable, memory);
    for (const skinning::PlaybackLayer& layer : desc.layers) {
        const double fadeEnd = layer.fadeStart + static_cast<double>(layer.fadeDuration);
        const bool fades = layer.fadeDuration > 0.0f && last > layer.fadeStart && first < fadeEnd;
        if (fades || skinning::clampsBetween(asset.character, layer, first, last)) {
            return true;
        }
        const bool travels = desc.travels && &layer == desc.layers.data();
        if ((travels || !asset.updates.closes(layer.clip, desc.root)) &&
            skinning::loopsAt(asset.character, layer, first) != skinning::loopsAt(asset.character, layer, last)) {
            return true;
        }
    }
    return false;
}

} // namespace supple::runtime
