// The patches of a group, and which parts of a character they belong to.
#pragma once

#include "host/context.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::host {

/// All patches of a surface, in device order.
[[nodiscard]] Result<std::vector<SupplePatchInfo>> patchesOf(Context& context, SuppleGroup group, uint32_t surface);

/// How many patches of a surface each part has. `faceParts`: the part of every face of the cage; empty: there is one.
[[nodiscard]] Result<std::vector<uint32_t>> patchesByPart(Context& context, SuppleGroup group, uint32_t surface,
                                                          std::span<const uint32_t> faceParts, size_t partCount);

} // namespace supple::host
