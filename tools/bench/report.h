// A benchmark's result as text: Markdown tables, which a terminal shows as well.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace supple::bench {

/// Machine, peers, agreement, a table a cage and clock, ratios, loading, pipelines, targets.
[[nodiscard]] std::string toTables(const nlohmann::ordered_json& result);

/// Why a file is no result of this benchmark; empty if it is one.
[[nodiscard]] std::string whyNoResult(const nlohmann::ordered_json& json);

} // namespace supple::bench
