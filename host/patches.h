// Which parts of a character the patches of a group belong to.
#pragma once

#include "host/context.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::host {

/// How many patches of a surface each part has. `faceParts`: the part of every face of the cage; empty: there is one.
[[nodiscard]] Result<std::vector<uint32_t>> patchesByPart(Context& context, SuppleGroup group, uint32_t surface,
                                                          std::span<const uint32_t> faceParts, size_t partCount);

} // namespace supple::host
