// Two measurements of supple profile, pass by pass: what changed, within which interval, and whether it is more than
// noise.
#pragma once

#include "base/result.h"

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace supple::tools {

/// Device times of one round of frames, in milliseconds.
struct MeasuredRound {
    std::vector<double> frame;
    std::map<std::string, std::vector<double>> passes; ///< frames without the pass have 0
};
/// What one run measured, in one round or in several.
struct MeasuredRun {
    std::string name;                ///< file, scheme and settings: runs of the same name are compared
    std::vector<std::string> passes; ///< in the order of the frame
    std::vector<MeasuredRound> rounds;
    std::string device; ///< its name
};

/// The runs of a result of --json. `where` names it in errors: a result without the times of its frames is refused.
[[nodiscard]] Result<std::vector<MeasuredRun>> measuredRuns(const nlohmann::ordered_json& result,
                                                            const std::string& where);
/// Adds the rounds of the runs of the same names; others come behind.
void addRounds(std::vector<MeasuredRun>& runs, std::vector<MeasuredRun> more);

/// A pass, or the whole frame. Changes are factors minus 1: 0.1 is 10 % slower.
struct PassChange {
    std::string pass;
    double before = 0.0, after = 0.0;           ///< medians, milliseconds; 0: not measured
    double change = 0.0, low = 0.0, high = 0.0; ///< and its interval
    bool significant = false;                   ///< the interval has no 0, and the change is above the noise floor
};
struct RunChange {
    std::string name;
    size_t rounds = 1;
    std::vector<PassChange> passes; ///< the frame comes last; empty: only one of both has this run
};

/// The median lies outside of all of n rounds once in 2^(n - 1): less than 0.1 % from 11 rounds on.
inline constexpr uint32_t kLeastRounds = 11;

/// What is taken for noise. If both have as many rounds, kLeastRounds or more, these are paired, and the interval is
/// that of the median of their changes. Else it is a bootstrap over blocks of frames. Then nothing tells a slower build
/// from a slower machine, so the floor is higher.
struct CompareRules {
    double confidence = 0.999;
    double floor = 0.05;         ///< of a change between paired rounds
    double floorOfFrames = 0.10; ///< of a change between two single rounds
    double leastMilliseconds = 0.002;
};
[[nodiscard]] std::vector<RunChange> compareRuns(const std::vector<MeasuredRun>& before,
                                                 const std::vector<MeasuredRun>& after, const CompareRules& rules = {});

[[nodiscard]] std::string toTable(const RunChange& run);
/// One line: "no slower", "slower: hero.glb, pm, rate 8, 1 instance: evaluate +12.3 %", or what was not compared.
[[nodiscard]] std::string verdictOf(const std::vector<RunChange>& runs);
[[nodiscard]] nlohmann::ordered_json toJson(const std::vector<RunChange>& runs);
/// "hero.glb, pm: evaluate 12.3 % slower" for each significant change above `percent`; none: empty.
[[nodiscard]] std::vector<std::string> slowerThan(const std::vector<RunChange>& runs, double percent);

} // namespace supple::tools
