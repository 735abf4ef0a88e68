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

/// Checks the crease sets of a description: that all have names, and that every crease is in one of them or in none.
/// `sets`: per crease, or null. Returns whether that is so. The names are there.
bool checkCreaseSets(uint32_t setCount, const char* const* names, uint32_t creaseCount, const uint32_t* sets,
                     Faults& faults);

} // namespace supple::runtime
