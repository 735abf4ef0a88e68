// What of a measurement a reader should see first: what costs most, and what would help.
#pragma once

#include "tools/supple/profile_summary.h"

#include <string>

namespace supple::tools {

/// "evaluate takes 62 % of the frame. A lower --rate ..": about the pass that takes longest, or gaps between passes
/// where they take more. Empty if nothing took time.
[[nodiscard]] std::string adviceOf(const ProfileRun& run);

} // namespace supple::tools
