// What the command line says of single parts: which to show, which scheme they have.
#pragma once

#include "base/result.h"
#include "cage/character.h"

#include <string>
#include <supple/supple.h>
#include <vector>

namespace supple::host {

/// Of every part, in the character's order; names may be empty.
[[nodiscard]] std::vector<std::string> partNames(const cage::Character& character);

/// By part: whether one of the texts names it, by its name or its index; without texts all are. A name means all parts
/// that have it. The error begins with `owner` and lists the parts there are.
[[nodiscard]] Result<std::vector<bool>> findParts(const std::string& owner, const std::vector<std::string>& names,
                                                  const std::vector<std::string>& texts);

struct PartScheme {
    std::string part; ///< name, else index
    SuppleScheme scheme = SUPPLE_SCHEME_AUTO;
};

/// "Hat=polygons", cut at the last "=". The error says what is wrong in a few words.
[[nodiscard]] Result<PartScheme> parsePartScheme(const std::string& text);

/// SuppleGroupDesc.partSchemes: of all parts, or empty without settings. Of settings for the same part the last counts.
[[nodiscard]] Result<std::vector<SuppleScheme>>
partSchemes(const std::string& owner, const std::vector<std::string>& names, const std::vector<PartScheme>& settings);

} // namespace supple::host
