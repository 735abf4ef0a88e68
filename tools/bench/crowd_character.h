// The character of the benchmark's crowd: the sphere with a skeleton and a clip, so that poses and skins are work.
#pragma once

#include "tools/bench/cages.h"

namespace supple::bench {

inline constexpr uint32_t kCrowdJoints = 64, kCrowdInfluences = 4, kCrowdKeys = 31;

/// Joints spread over the sphere, joint j a child of joint (j - 1) / 2, which makes seven levels; every vertex follows
/// the four nearest; a clip of a second turns every joint to and fro and ends as it begins.
[[nodiscard]] Result<BenchCage> makeCrowdCharacter();

} // namespace supple::bench
