// Materials and images of a character, as supple inspect prints them.
#pragma once

#include "cage/character.h"

#include <nlohmann/json.hpp>
#include <string>

namespace supple::tools {

/// Everything, defaults too.
[[nodiscard]] nlohmann::ordered_json materialJson(const cage::Material& material);
/// One line: what differs from glTF's defaults.
[[nodiscard]] std::string materialText(const cage::Material& material);

} // namespace supple::tools
