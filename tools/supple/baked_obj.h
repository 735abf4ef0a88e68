// What supple bake has evaluated, as OBJ: patch by patch, exactly as the device wrote it.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "tools/supple/evaluation.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace supple::tools {

/// Parts follow each other as the character has them. Patches are numbered surface by surface. `askedRate`: what the
/// command line said.
[[nodiscard]] Status writeObj(const std::string& path, const Evaluation& baked, size_t partCount, uint32_t askedRate);

/// The deformed cage.
[[nodiscard]] Status writeCageObj(const std::string& path, const Evaluation& baked, const cage::Cage& cage);

} // namespace supple::tools
