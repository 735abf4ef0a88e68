// The clips of a character out of a host's arrays. Private to runtime/arrays/.
#pragma once

#include "cage/character.h"
#include "cage/message.h"
#include "runtime/arrays/faults.h"
#include "supple/supple.h"

#include <cstddef>
#include <span>
#include <vector>

namespace supple::runtime {

/// Checks the clips and returns them. `targetCounts`: by node, the morph targets of the part that it carries.
[[nodiscard]] std::vector<cage::Clip> readClipArrays(const SuppleCharacterDesc& desc, const cage::Skeleton& skeleton,
                                                     std::span<const size_t> targetCounts, cage::Refusals& refusals,
                                                     cage::Warnings& warnings);

} // namespace supple::runtime
