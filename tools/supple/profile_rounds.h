// Two builds of the command, measured in turns: what disturbs the machine disturbs both.
#pragma once

#include "tools/supple/profile_compare.h"

#include <string>
#include <vector>

namespace supple::tools {

struct RoundsOptions {
    std::string against; ///< the other build's command
    uint32_t rounds = 16;
    uint32_t frames = 60;               ///< a round
    uint32_t timeout = 600;             ///< seconds that a round of one build may take
    std::vector<std::string> arguments; ///< of this command line, the subcommand first
};

struct MeasuredPair {
    std::vector<MeasuredRun> before, after;
};

/// Runs both commands with the same arguments, by turns the one and the other first. Options that write files or judge
/// are left out.
[[nodiscard]] Result<MeasuredPair> measureInTurns(const RoundsOptions& options);

} // namespace supple::tools
