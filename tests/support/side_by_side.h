// One cage several times side by side, as parts of one character.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <string>

namespace supple::test {

/// Parts `name` 0, 1, .. at every 6 units along x, each bound as a whole to a joint of its own. No clips.
[[nodiscard]] cage::Character sideBySide(const cage::Cage& cage, const std::string& name, uint32_t count);

} // namespace supple::test
