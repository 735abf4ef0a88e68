// A part of split vertices and triangles out of a host's arrays. Private to runtime/arrays/.
#pragma once

#include "cage/bind_space.h"
#include "cage/parts.h"
#include "runtime/arrays/faults.h"
#include "runtime/arrays/part_context.h"
#include "supple/supple.h"

namespace supple::runtime {

/// Checks the part's primitives. Without a fault it fills the part's cage, weights and displacements; its morph targets
/// must be there.
void readPrimitiveArrays(const SupplePartDesc& desc, const cage::MeshBinding& binding, const PartContext& context,
                         cage::PartCage& part, Faults& faults);

} // namespace supple::runtime
