// Which numbers the smoothing of delta mush may have.
#pragma once

#include "cage/character.h"

namespace supple::cage {

inline constexpr float kMinSmoothingLambda = 0.01f, kMaxSmoothingLambda = 10.0f;
inline constexpr uint32_t kMaxSmoothingIterations = 32;

[[nodiscard]] inline bool isSound(const Smoothing& smoothing) {
    return smoothing.lambda >= kMinSmoothingLambda && smoothing.lambda <= kMaxSmoothingLambda &&
           smoothing.iterations >= 1 && smoothing.iterations <= kMaxSmoothingIterations;
}

/// What the first part says that says something: a cage is smoothed as a whole.
[[nodiscard]] inline Smoothing smoothingOf(const Character& character) {
    for (const Part& part : character.parts) {
        if (part.smoothing) {
            return *part.smoothing;
        }
    }
    return {};
}

} // namespace supple::cage
