// A control cage out of a host's arrays. Private to runtime/arrays/.
#pragma once

#include "cage/parts.h"
#include "runtime/arrays/faults.h"
#include "supple/supple.h"

#include <span>
#include <vector>

namespace supple::runtime {

/// Checks the arrays. Without a fault it fills the part's cage, its damages and its number of source vertices. Faces of
/// fewer than three corners and vertices without a face are left out, which is damage; Cage::sourceVertices says what
/// is left. `materials` are the character's.
void readCageArrays(const SuppleCageDesc& desc, std::span<const cage::Material> materials, cage::PartCage& part,
                    Faults& faults);

} // namespace supple::runtime
