// What supple inspect tells of what jiggles.
#pragma once

#include "cage/character.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace supple::tools {

/// [{frequency, damping, limit, vertices}], with how many vertices have it.
[[nodiscard]] nlohmann::ordered_json jigglesToJson(const cage::Character& character);

/// One line per jiggle.
[[nodiscard]] std::vector<std::string> jiggleLines(const cage::Character& character);

} // namespace supple::tools
