// Holds a result against a stored one: what has become slower.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace supple::bench {

inline constexpr double kRegression = 1.15;

/// Why nothing can be held against a stored result of this machine: it is not complete, has nothing that is compared,
/// or is of another device or mapping. Empty: it can.
[[nodiscard]] std::string whyNoCheck(const nlohmann::ordered_json& stored, const std::string& device,
                                     const std::string& mapping);

/// One line for every setting of the measurement that is not that of the stored result, and may make ratios differ.
[[nodiscard]] std::vector<std::string> otherSettings(const nlohmann::ordered_json& stored,
                                                     const nlohmann::ordered_json& now);

/// One line for every first frame, of this result and of the stored one if that has it: what drivers do in it differs
/// too much to be judged.
[[nodiscard]] std::vector<std::string> firstFrames(const nlohmann::ordered_json& stored,
                                                   const nlohmann::ordered_json& now);

/// One line for every contestant that has become dearer by more than 15 % beside each of its yardsticks (all of them,
/// since one of them alone may have had a good day), and for every stored ratio over a yardstick that is gone. Of what
/// both results have also: on GPUs a line for every crowd whose share of the write bandwidth has become lower by more
/// than 15 %, and one wherever static device data has grown by more than that. Where neither a ratio over a yardstick
/// nor such a share could be compared, the only line says so. None means that the check passes. What is new is not
/// looked at, nor are ratios of Supple's passes among each other: they grow where the other becomes faster.
[[nodiscard]] std::vector<std::string> findRegressions(const nlohmann::ordered_json& stored,
                                                       const nlohmann::ordered_json& now);

} // namespace supple::bench
