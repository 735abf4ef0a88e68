// The nodes of a character out of a host's arrays. Private to runtime/arrays/.
#pragma once

#include "cage/character.h"
#include "runtime/arrays/faults.h"
#include "supple/supple.h"

#include <string>

namespace supple::runtime {

/// The 16 numbers of a transform, which a fault calls `what`.
void readMatrix(const float* from, const std::string& what, glm::mat4& to, Faults& faults);

/// Checks the nodes, and fills the skeleton.
void readNodeArrays(const SuppleCharacterDesc& desc, cage::Skeleton& skeleton, cage::Refusals& refusals);

} // namespace supple::runtime
