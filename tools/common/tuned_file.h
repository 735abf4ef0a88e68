// A glTF file whose springs, jiggles and cloths are stiffer, heavier, more damped: to try numbers while a figure moves.
#pragma once

#include "base/result.h"
#include "tools/common/character_file.h"

namespace supple::host {

/// What the file's own numbers are multiplied by.
struct Tuning {
    float stiffness = 1.0f; ///< of springs and cloths; jiggles swing as their springs were so much stiffer
    float damping = 1.0f;   ///< dragForce; damping of jiggles; drag and air of cloths
    float gravity = 1.0f;   ///< gravityPower; gravity of cloths

    bool operator==(const Tuning&) const = default;
};

/// The file with its numbers multiplied, as far as files may have them. Errors: it is neither glTF nor GLB.
[[nodiscard]] Result<CharacterFile> tunedFile(const CharacterFile& file, const Tuning& tuning);

} // namespace supple::host
