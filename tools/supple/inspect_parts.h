// What supple inspect tells of the parts of a character.
#pragma once

#include "cage/character.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace supple::tools {

/// [{name, node, rigid, faces, vertices, polygonSource, weldSource, morphTargets, materials}]
[[nodiscard]] nlohmann::ordered_json partsToJson(const cage::Character& character);

/// One line per part.
[[nodiscard]] std::vector<std::string> partLines(const cage::Character& character);

} // namespace supple::tools
