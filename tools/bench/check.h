// Holds a result against a stored one: what has become slower.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace supple::bench {

inline constexpr double kRegression = 1.15;

/// One line for every contestant that has become dearer by more than 15 % beside each of its yardsticks (all of them,
/// since one of them alone may have had a good day), and for every stored ratio over a yardstick that is gone. None
/// means that the check passes. What is new is not looked at, nor are ratios of Supple's passes among each other: they
/// grow where the other becomes faster.
[[nodiscard]] std::vector<std::string> findRegressions(const nlohmann::ordered_json& stored,
                                                       const nlohmann::ordered_json& now);

} // namespace supple::bench
