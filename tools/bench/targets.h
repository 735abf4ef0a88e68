// The targets that the issue of a release sets, held against a result.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace supple::bench {

/// An array of {what, where, value, limit, met}. Ratios have targets on CPU devices alone. `value` and `met` are null
/// for what the library does not have yet, with a note that says so; what a result does not hold has no entry.
[[nodiscard]] nlohmann::ordered_json judge(const nlohmann::ordered_json& result);

} // namespace supple::bench
