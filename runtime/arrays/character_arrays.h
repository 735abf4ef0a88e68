// A character out of a host's arrays.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "cage/finish.h"
#include "cage/split/cage.h"
#include "supple/supple.h"

#include <string>

namespace supple::runtime {

/// The description must be of this version (readSized); what it points to may be of any. Errors have a line for each
/// fault: "hero: part 2: ...".
[[nodiscard]] Result<cage::Character> characterFromArrays(const SuppleCharacterDesc& desc, const std::string& name,
                                                          const cage::FinishOptions& options = {},
                                                          cage::Pairing pairing = cage::Pairing::whereClean);

/// A bare cage: a character of one part that follows one joint, which is called `name`.
[[nodiscard]] Result<cage::Character> characterFromArrays(const SuppleCageDesc& desc, const std::string& name,
                                                          const cage::FinishOptions& options = {});

} // namespace supple::runtime
