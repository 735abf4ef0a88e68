// What the device itself finds on a group: suppleRecordQueries.
#pragma once

#include "tools/supple/session.h"

#include <optional>
#include <supple/supple.h>

namespace supple::tools {

/// Asks with one ray or one place of the host (`asked`: nothing else of it counts), in another frame with the poses of
/// the last one. Nothing: it is a miss.
[[nodiscard]] Result<std::optional<SuppleHit>> pickOnDevice(Session& session, SuppleGroup group, SuppleQueryDesc asked);

} // namespace supple::tools
