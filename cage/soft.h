// Which numbers jiggles and cloths may have.
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

inline constexpr float kMaxClothCompliance = 1e3f;
inline constexpr float kMaxClothTether = 10.0f;
inline constexpr float kMaxClothGravity = 1e4f;
inline constexpr uint32_t kMaxClothSubsteps = 8;
inline constexpr size_t kMaxClothColliders = 16;
inline constexpr size_t kMaxCloths = 16; // of a mesh

/// Without its colliders.
[[nodiscard]] inline bool isSound(const Cloth& cloth) {
    const auto within = [](float x, float most) { return x >= 0.0f && x <= most; };
    return within(cloth.stretch, kMaxClothCompliance) && within(cloth.shear, kMaxClothCompliance) &&
           within(cloth.bend, kMaxClothCompliance) && within(cloth.tether, kMaxClothTether) &&
           (cloth.tether == 0.0f || cloth.tether >= 1.0f) && within(cloth.drag, 1.0f) && within(cloth.air, 1.0f) &&
           within(cloth.gravity, kMaxClothGravity) && within(cloth.hitRadius, kMaxCoordinate) && cloth.substeps >= 1 &&
           cloth.substeps <= kMaxClothSubsteps && cloth.colliders.size() <= kMaxClothColliders;
}

} // namespace supple::cage
