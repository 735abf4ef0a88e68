// Morph targets set by name. Parts have targets of their own, so several targets may have one name: all of them are
// set.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "host/figure.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::host {

struct MorphSetting {
    std::string target; ///< name, else number
    float weight = 0.0f;
    bool isExpression = false; ///< then `target` is its name
};

/// "smile=0.5", cut at the last "=". The error says what is wrong in a few words.
[[nodiscard]] Result<MorphSetting> parseMorph(const std::string& text);
/// The same of an expression.
[[nodiscard]] Result<MorphSetting> parseExpression(const std::string& text);

/// The weights of all targets, as suppleSetMorphWeights takes them: those that the settings name, else what expressions
/// make of those that the file gives. Empty without settings. The error lists the names there are.
[[nodiscard]] Result<std::vector<float>> morphWeights(const Figure& figure, const std::vector<MorphSetting>& settings);
[[nodiscard]] Result<std::vector<float>> morphWeights(const cage::Character& character,
                                                      const std::vector<MorphSetting>& settings);

/// Targets of one name, which are set together.
struct NamedTargets {
    std::string name; ///< "target 3" where the file has none
    std::vector<uint32_t> targets;
};
/// In the order of the first target of each name.
[[nodiscard]] std::vector<NamedTargets> targetsByName(const Figure& figure);

} // namespace supple::host
