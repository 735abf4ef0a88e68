// Which scheme each part of a group has, and so which surfaces the group has.
#pragma once

#include "base/result.h"
#include "runtime/prepared.h"
#include "supple/supple.h"

#include <cstdint>
#include <vector>

namespace supple::runtime {

/// The parts of a group that have one scheme.
struct SchemeParts {
    SuppleScheme scheme = SUPPLE_SCHEME_AUTO; ///< never AUTO
    bool chosen = true;                       ///< the host asked for no scheme, for none of these parts
    std::vector<uint32_t> parts;              ///< rising
};

/// One entry per scheme, by their first parts. Parts that are sewn have one scheme: that of a part which the
/// description names counts for those sewn to it. Refuses a description that names two for sewn parts.
[[nodiscard]] Result<std::vector<SchemeParts>> schemesOf(const Prepared& prepared, const SuppleGroupDesc& desc);

} // namespace supple::runtime
