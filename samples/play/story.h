// A player that always does the same.
#pragma once

#include "game.h"

namespace play {

inline constexpr double kStorySeconds = 9.25;
/// What the player does in the frame that ends at `time` and lasts `seconds`.
[[nodiscard]] Input storyInput(double time, double seconds);

} // namespace play
