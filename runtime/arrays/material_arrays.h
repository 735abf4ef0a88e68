// Images and materials of a character out of a host's arrays. Private to runtime/arrays/.
#pragma once

#include "cage/character.h"
#include "cage/message.h"
#include "runtime/arrays/faults.h"
#include "supple/supple.h"

#include <span>
#include <vector>

namespace supple::runtime {

/// Copies the images; one without bytes is a warning.
[[nodiscard]] std::vector<cage::Image> readImageArrays(const SuppleCharacterDesc& desc, cage::Refusals& refusals,
                                                       cage::Warnings& warnings);

/// Checks the materials and returns them. Numbers out of their range become the nearest in it, with a warning.
[[nodiscard]] std::vector<cage::Material> readMaterialArrays(const SuppleCharacterDesc& desc,
                                                             std::span<const cage::Image> images,
                                                             cage::Refusals& refusals, cage::Warnings& warnings);

} // namespace supple::runtime
