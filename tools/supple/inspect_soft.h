// What supple inspect tells of what jiggles and what is cloth.
#pragma once

#include "cage/character.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace supple::tools {

/// [{frequency, damping, limit, vertices}], with how many vertices have it.
[[nodiscard]] nlohmann::ordered_json jigglesToJson(const cage::Character& character);
/// [{stretch, shear, bend, .., vertices}], with how many vertices are painted.
[[nodiscard]] nlohmann::ordered_json clothsToJson(const cage::Character& character);

/// One line per jiggle, and per cloth.
[[nodiscard]] std::vector<std::string> jiggleLines(const cage::Character& character);
[[nodiscard]] std::vector<std::string> clothLines(const cage::Character& character);

} // namespace supple::tools
