// The end of the one way to a character: glTF files, OBJ files and the host's arrays all come through here.
#pragma once

#include "cage/character.h"
#include "cage/normal_creases.h"
#include "cage/parts.h"

#include <vector>

namespace supple::cage {

struct FinishOptions {
    bool sewParts = true; ///< sew parts together where their boundaries coincide
    NormalCreases normalCreases = NormalCreases::never;
    bool strict = false; ///< refuse a damaged cage instead of repairing it (cage/repair.h)
};

/// Makes a character of its parts, one or more: joins and sews them, repairs the cage, and says what was found. The
/// character must have what its maker knows besides: name, skeleton, palette, clips, materials, images, and the
/// warnings and damages so far. Throws Refusal (cage/refusal.h), whose faults are without the character's name.
void finishCharacter(std::vector<PartCage> parts, const FinishOptions& options, Character& character);

} // namespace supple::cage
