// Holds a result against a stored one: what has become slower.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace supple::bench {

inline constexpr double kRegression = 1.15;

/// One line for every stored ratio that has grown by more than 15 % or is gone, "CAGE, rate R: RATIO: ..."; none means
/// that the check passes. Ratios that are new are not looked at.
[[nodiscard]] std::vector<std::string> findRegressions(const nlohmann::ordered_json& stored,
                                                       const nlohmann::ordered_json& now);

} // namespace supple::bench
