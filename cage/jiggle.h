// Which numbers jiggles may have.
#pragma once

#include "cage/character.h"
#include "cage/limits.h"

#include <cstddef>

namespace supple::cage {

inline constexpr float kMinJiggleFrequency = 0.05f, kMaxJiggleFrequency = 30.0f; // half the steps of a second
inline constexpr float kMaxJiggleDamping = 10.0f;
inline constexpr float kMinJiggleLimit = 1e-6f;
inline constexpr size_t kMaxJiggles = 16; // of a mesh

[[nodiscard]] inline bool isSound(const Jiggle& jiggle) {
    return jiggle.frequency >= kMinJiggleFrequency && jiggle.frequency <= kMaxJiggleFrequency &&
           jiggle.damping >= 0.0f && jiggle.damping <= kMaxJiggleDamping && jiggle.limit >= kMinJiggleLimit &&
           jiggle.limit <= kMaxCoordinate;
}

} // namespace supple::cage
