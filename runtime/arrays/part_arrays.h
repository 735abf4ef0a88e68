// A part of a character out of a host's arrays. Private to runtime/arrays/.
#pragma once

#include "cage/bind_space.h"
#include "cage/parts.h"
#include "runtime/arrays/faults.h"
#include "runtime/arrays/part_context.h"
#include "supple/supple.h"

namespace supple::runtime {

/// Checks the description, and fills the part and what it is bound to. If there is a fault, both are of no use.
void readPartArrays(const SupplePartDesc& desc, const PartContext& context, cage::PartCage& part,
                    cage::MeshBinding& binding, Faults& faults);

} // namespace supple::runtime
