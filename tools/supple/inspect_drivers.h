// What supple inspect tells of pose drivers.
#pragma once

#include "cage/character.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace supple::tools {

/// [{name, inputs: [{node, part}], morphTargets, poses, condition, closestDegrees}], poses without the rest pose.
[[nodiscard]] nlohmann::ordered_json driversToJson(const cage::Character& character);

/// One line per driver.
[[nodiscard]] std::vector<std::string> driverLines(const cage::Character& character);

} // namespace supple::tools
