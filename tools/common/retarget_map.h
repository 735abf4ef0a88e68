// A file that says which joints of clips are which of a character, where names do not tell (--retarget-map).
#pragma once

#include "base/result.h"

#include <string>
#include <supple/supple.h>
#include <vector>

namespace supple::host {

/// SuppleJointPair, with texts of its own; empty ones are null.
struct JointPairSetting {
    std::string role, from, to;
};

/// JSON: {"roles": {"thigh.l": {"from": "Bone.012", "to": "leg_l"}, "hips": {"from": "Root"}},
///        "joints": [{"from": "Tail1", "to": "tail_01"}]}
/// `name` begins errors, which have a line for each fault.
[[nodiscard]] Result<std::vector<JointPairSetting>> parseRetargetMap(const std::string& text, const std::string& name);

/// What points to the texts of the settings.
[[nodiscard]] std::vector<SuppleJointPair> jointPairsOf(const std::vector<JointPairSetting>& settings);

} // namespace supple::host
