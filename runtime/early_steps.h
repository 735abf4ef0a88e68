// Steps of the grid of times that a frame runs before those that it poses with what is shown: if it has more due than
// its working memory holds at once.
#pragma once

#include "runtime/frame.h"

namespace supple::runtime {

[[nodiscard]] bool hasEarlySteps(Group& group);
/// Those of all groups of the frame, which share barriers; with the first group. Barriers stand before and behind them.
PassCost recordEarlySteps(const Frame& frame, Group& group);

} // namespace supple::runtime
