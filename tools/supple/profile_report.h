// The forms of what supple profile measured: table, JSON, CSV, Chrome trace.
#pragma once

#include "tools/common/machine.h"
#include "tools/supple/profile_summary.h"

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

namespace supple::tools {

/// "30000 vertices of 42000 wanted, ..": what a view drew.
[[nodiscard]] std::string drawnText(const ProfileRun& run, const RunSummary& summary);
[[nodiscard]] std::string toTable(const ProfileRun& run, const RunSummary& summary);
[[nodiscard]] nlohmann::ordered_json toJson(const Machine& machine, std::span<const ProfileRun> runs);
[[nodiscard]] std::string toCsv(std::span<const ProfileRun> runs);
/// Chrome trace events, for Perfetto and chrome://tracing: a process a run, in it a track for the device and one for
/// the CPU, and counters. The two clocks were read together (VK_EXT_calibrated_timestamps); on a device without that
/// they are laid together at the first frame: its work begins when it was submitted. otherData says which.
[[nodiscard]] nlohmann::ordered_json toTrace(const Machine& machine, std::span<const ProfileRun> runs);

} // namespace supple::tools
